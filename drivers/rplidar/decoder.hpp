// SPDX-License-Identifier: MIT
// The bytes of an RPLidar A1 become samples: a pure function, without time, port or log.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>

#include "drivers/lidar_driver.hpp"

namespace cornerd::rplidar {

/// The three answers to a scan request that an A1 knows (answer types 0x81, 0x82, 0x84).
enum class WireFormat : std::uint8_t { kStandard, kExpress, kUltra };

/// A sample as the wire has it. Device angles count clockwise.
struct RawSample {
  std::uint64_t index = 0;     ///< counts sample periods since the start, lost ones included
  std::uint16_t angle_q6 = 0;  ///< degrees * 64, below 360 * 64
  std::uint32_t dist_q2 = 0;   ///< millimetres * 4; 0: nothing returned
  std::uint8_t quality = 0;    ///< 0..63; express and ultra carry none: 47 with a return, else 0
  bool starts_scan = false;    ///< decided by the angle; the device's own flag only supports it
};

class RawSampleSink {
 public:
  virtual ~RawSampleSink() = default;
  virtual void on_sample(const RawSample& sample) = 0;
  /// Samples are missing here and their number is not known.
  virtual void on_gap() = 0;
};

/// Accepts any bytes in any portions; the samples do not depend on how the bytes were cut up.
/// Allocates nothing after construction.
class Decoder {
 public:
  /// `format`: of a stream that begins without a response descriptor; nullopt: find out from the
  /// bytes. A descriptor in the stream decides in any case.
  explicit Decoder(std::optional<WireFormat> format = std::nullopt);
  ~Decoder();
  Decoder(Decoder&&) noexcept;
  Decoder& operator=(Decoder&&) noexcept;

  void feed(std::span<const std::uint8_t> bytes, RawSampleSink& sink);

  /// The end of a recording: delivers what is still held back because its successor could have
  /// disproved it. A capsule without a successor stays undecodable, and is counted.
  void finish(RawSampleSink& sink);

  /// The format in force; nullopt while it is not known.
  std::optional<WireFormat> format() const;
  const drivers::StreamCounters& counters() const;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace cornerd::rplidar
