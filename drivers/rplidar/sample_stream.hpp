// SPDX-License-Identifier: MIT
// Bytes with the time of their arrival become samples with the time of their measurement.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>

#include "drivers/lidar_driver.hpp"
#include "drivers/rplidar/decoder.hpp"

namespace cornerd::rplidar {

struct SampleStreamConfig {
  std::optional<WireFormat> format;  ///< of a stream without a descriptor; nullopt: find out
  bool inverted = false;             ///< mounted upside down: bearing = +angle instead of -angle
  double sample_period_s =
      0;  ///< what the device says; the format's usual one where that cannot be
  std::uint32_t baud = 115200;
};

/// Decoder and sample clock in one. Allocates nothing after construction.
class SampleStream {
 public:
  explicit SampleStream(const SampleStreamConfig& config);
  ~SampleStream();
  SampleStream(SampleStream&&) noexcept;
  SampleStream& operator=(SampleStream&&) noexcept;

  /// `arrival_ns`: when the last of these bytes was read from the port. Samples whose time is in
  /// doubt are given when it is known. `more_waits`: the port had more than these.
  void feed(std::span<const std::uint8_t> bytes, core::TimeNs arrival_ns, drivers::SampleSink& sink,
            bool more_waits = false);
  /// Bytes that bear no clock: time runs from 0 as their transmission at `baud` would have it.
  void feed_untimed(std::span<const std::uint8_t> bytes, drivers::SampleSink& sink);
  void finish(drivers::SampleSink& sink);

  std::optional<WireFormat> format() const;
  /// So far, those that wait for their time as well.
  std::uint64_t samples() const;
  const drivers::StreamCounters& counters() const;
  /// Of each feed() that brought samples: how much later it came than could be.
  const core::Lateness& lateness() const;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace cornerd::rplidar
