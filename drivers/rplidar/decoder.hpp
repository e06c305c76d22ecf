// SPDX-License-Identifier: MIT
// Turns the bytes of an RPLidar A1 into samples. A pure function: no time, port or log.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>

#include "drivers/lidar_driver.hpp"

namespace cornerd::rplidar {

/// The answers of an A1 to a scan request: types 0x81, 0x82, 0x84.
enum class WireFormat : std::uint8_t { kStandard, kExpress, kUltra };

/// A sample in the wire's units. Device angles count clockwise.
struct RawSample {
  std::uint64_t index = 0;     ///< sample periods since the start, lost ones included
  std::uint16_t angle_q6 = 0;  ///< degrees * 64, below 360 * 64
  std::uint32_t dist_q2 = 0;   ///< millimetres * 4; 0: no return
  std::uint8_t quality = 0;    ///< 0..63; express and ultra have none: 47 with a return, else 0
  bool starts_scan = false;    ///< by the angle; the device's flag only refines it
};

class RawSampleSink {
 public:
  virtual ~RawSampleSink() = default;
  virtual void on_sample(const RawSample& sample) = 0;
  /// An unknown number of samples is missing here.
  virtual void on_gap() = 0;
};

/// Accepts any bytes in any portions; the portions do not change the samples. Allocates nothing
/// after construction.
class Decoder {
 public:
  /// `format`: of a stream without a response descriptor; nullopt: detect it. A descriptor in the
  /// stream takes precedence.
  explicit Decoder(std::optional<WireFormat> format = std::nullopt);
  ~Decoder();
  Decoder(Decoder&&) noexcept;
  Decoder& operator=(Decoder&&) noexcept;

  void feed(std::span<const std::uint8_t> bytes, RawSampleSink& sink);

  /// End of a recording: delivers the nodes still awaiting confirmation. A capsule without a
  /// successor stays undecodable, and is counted.
  void finish(RawSampleSink& sink);

  /// nullopt while it is not known.
  std::optional<WireFormat> format() const;
  const drivers::StreamCounters& counters() const;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace cornerd::rplidar
