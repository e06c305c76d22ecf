// SPDX-License-Identifier: MIT
// What the decoder of every lidar implements. A pure function of bytes: no time, port or log.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "drivers/lidar_status.hpp"

namespace cornerd::drivers {

/// A decoded sample, without a time.
struct FrameSample {
  std::uint64_t index = 0;   ///< sample periods since the start, lost ones included
  float device_rad = 0;      ///< clockwise from the zero mark, -pi to pi
  float range_m = 0;         ///< 0: no return
  std::uint8_t quality = 0;  ///< as on the wire; 0 if the format has none
  bool starts_scan = false;
};

class FrameSink {
 public:
  virtual ~FrameSink() = default;
  virtual void on_sample(const FrameSample& sample) = 0;
  /// An unknown number of samples is missing here.
  virtual void on_gap() = 0;
};

/// How the newest packet was sent.
struct FrameTiming {
  double period_s = 0;            ///< between samples, nominal; another value: another stream
  std::size_t packet_bytes = 0;   ///< its size
  std::size_t samples_ahead = 0;  ///< from its first sample delivered to its newest one measured
};

/// Accepts any bytes in any portions; the portions do not change the samples. Allocates nothing
/// after construction.
class FrameDecoder {
 public:
  virtual ~FrameDecoder() = default;
  virtual void feed(std::span<const std::uint8_t> bytes, FrameSink& sink) = 0;
  /// The end of a recording: delivers what waits for more bytes.
  virtual void finish(FrameSink& sink) = 0;
  /// Valid while a sample is delivered.
  virtual FrameTiming timing() const = 0;
  /// In the end bytes = used_bytes + skipped_bytes.
  virtual const StreamCounters& counters() const = 0;
};

}  // namespace cornerd::drivers
