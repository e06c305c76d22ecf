// SPDX-License-Identifier: MIT
// Turns bytes with arrival times into samples with measurement times.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>

#include "drivers/lidar_driver.hpp"
#include "drivers/rplidar/decoder.hpp"

namespace cornerd::rplidar {

struct SampleStreamConfig {
  std::optional<WireFormat> format;  ///< of a stream without a descriptor; nullopt: detect
  bool inverted = false;             ///< mounted upside down: bearing = +angle instead of -angle
  double sample_period_s = 0;  ///< as the device reports; implausible: the format's nominal one
  std::uint32_t baud = 115200;
};

/// Decoder plus sample clock. Allocates nothing after construction.
class SampleStream {
 public:
  explicit SampleStream(const SampleStreamConfig& config);
  ~SampleStream();
  SampleStream(SampleStream&&) noexcept;
  SampleStream& operator=(SampleStream&&) noexcept;

  /// `arrival_ns`: read time of the last byte. `more_pending`: the read left bytes behind. Samples
  /// of uncertain time are held until it is known.
  void feed(std::span<const std::uint8_t> bytes, core::TimeNs arrival_ns, drivers::SampleSink& sink,
            bool more_pending = false);
  /// Bytes without arrival times: sample i has time i * period.
  void feed_untimed(std::span<const std::uint8_t> bytes, drivers::SampleSink& sink);
  void finish(drivers::SampleSink& sink);

  std::optional<WireFormat> format() const;
  /// Decoded so far, those with a pending time included.
  std::uint64_t samples() const;
  const drivers::StreamCounters& counters() const;
  /// Delay of each feed() that brought samples.
  const core::LatencyHistogram& latency() const;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace cornerd::rplidar
