// SPDX-License-Identifier: MIT
// Turns the bytes of an RPLidar into samples. A pure function: no time, port or log.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>

#include "drivers/lidar_driver.hpp"

namespace cornerd::rplidar {

/// The answers to a scan request.
enum class WireFormat : std::uint8_t {
  kStandard,    ///< 0x81: nodes
  kExpress,     ///< 0x82
  kUltra,       ///< 0x84
  kDense,       ///< 0x85
  kUltraDense,  ///< 0x86
  kHq,          ///< 0x83
};

/// A sample in the wire's units. Device angles count clockwise.
struct RawSample {
  std::uint64_t index = 0;     ///< sample periods since the start, lost ones included
  std::uint16_t angle_q6 = 0;  ///< degrees * 64, below 360 * 64
  std::uint32_t dist_q2 = 0;   ///< millimetres * 4; 0: no return
  /// 0..63 of nodes, 0..255 of ultra-dense and HQ; the others have none: 47 with a return, else 0
  std::uint8_t quality = 0;
  bool starts_scan = false;  ///< by the angle; the device's flag only refines it
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
  /// `format`: of a stream without a response descriptor; nullopt: detect it, other than dense and
  /// HQ. A descriptor in the stream takes precedence.
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
