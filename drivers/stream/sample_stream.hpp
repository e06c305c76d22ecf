// SPDX-License-Identifier: MIT
// Turns bytes with arrival times into samples with measurement times.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/latency_histogram.hpp"
#include "drivers/lidar_driver.hpp"
#include "drivers/stream/frame_decoder.hpp"
#include "drivers/stream/sample_clock.hpp"

namespace cornerd::drivers {

struct StreamConfig {
  bool inverted = false;       ///< mounted upside down: bearing = +angle instead of -angle
  double sample_period_s = 0;  ///< as the device reports; implausible: the format's nominal one
  std::uint32_t baud = 115200;
};

/// Decoder plus sample clock. Allocates nothing after construction.
class SampleStream : private FrameSink {
 public:
  SampleStream(std::unique_ptr<FrameDecoder> decoder, const StreamConfig& config);
  ~SampleStream() override = default;

  /// `arrival_ns`: read time of the last byte. `more_pending`: the read left bytes behind. Samples
  /// of uncertain time are held until it is known.
  void feed(std::span<const std::uint8_t> bytes, core::TimeNs arrival_ns, SampleSink& sink,
            bool more_pending = false);
  /// Bytes without arrival times: sample i has time i * period.
  void feed_untimed(std::span<const std::uint8_t> bytes, SampleSink& sink);
  void finish(SampleSink& sink);

  /// Decoded so far, those with a pending time included.
  std::uint64_t samples() const { return samples_; }
  const StreamCounters& counters() const;
  /// Delay of each feed() that brought samples.
  const core::LatencyHistogram& latency() const { return latency_; }

 private:
  void on_sample(const FrameSample& raw) override;
  void on_gap() override;
  void hold(const FrameSample& raw);
  void release(bool after_pause);
  void drop_held();
  void deliver(const FrameSample& raw);
  void observe(const FrameSample& raw, const FrameTiming& timing);
  double period_s(double nominal_s) const;

  StreamConfig config_;
  std::unique_ptr<FrameDecoder> decoder_;
  SampleClock clock_;
  double nominal_period_s_ = 0;  ///< of clock_
  SampleSink* sink_ = nullptr;
  core::TimeNs piece_arrival_ns_ = 0;
  core::TimeNs packet_arrival_ns_ = 0;  ///< of the newest observation
  bool more_pending_ = false;
  bool first_of_piece_ = false;
  bool first_of_feed_ = false;
  core::LatencyHistogram latency_;
  bool timed_ = true;
  std::uint64_t samples_ = 0;
  std::vector<FrameSample> held_;    ///< their time is uncertain
  std::uint64_t dropped_ = 0;        ///< of held_
  bool has_gap_ = false;             ///< samples were dropped since the last delivered one
  mutable StreamCounters counters_;  ///< of counters()
};

}  // namespace cornerd::drivers
