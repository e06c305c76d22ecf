// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

#include "core/ring_buffer.hpp"
#include "core/triple_buffer.hpp"
#include "core/types.hpp"
#include "drivers/lidar_driver.hpp"

namespace cornerd::drivers {

/// The status of a device, written by the reader thread and read by another one. Wait-free, without
/// allocation.
class StatusBoard {
 public:
  /// Reader thread: all methods up to update().
  void set_state(LidarState state, LidarFault fault, std::string_view detail);
  void set_device(std::string_view model, std::string_view firmware, std::string_view serial,
                  const LidarModel* known = nullptr);
  void set_health(std::string_view health);
  void set_mode(std::string_view mode);

  LidarState state() const { return status_.state; }
  LidarFault fault() const { return status_.fault; }
  std::string_view detail() const { return status_.detail.view(); }

  /// Adds bytes received outside a stream; `used_bytes` of them were answers.
  void count_answers(std::uint64_t bytes, std::uint64_t used_bytes);

  /// Counters of the new stream add to those before.
  void begin_stream();
  /// Counts the bytes left undecoded as skipped.
  void end_stream(StreamCounters of_stream);
  void count(const core::Sample& sample);
  /// Publishes counters and rates, twice a second at most.
  void update(const StreamCounters& of_stream, const core::LatencyHistogram& latency,
              core::TimeNs now_ns);

  /// The other thread.
  LidarStatus read() { return latest_.read(); }
  bool take_change(LidarChange& change) { return changes_.pop(change); }

 private:
  void publish() { latest_.publish(status_); }
  void measure_rates();

  LidarStatus status_;
  StreamCounters before_;  ///< of the streams that have ended
  core::TimeNs updated_ns_ = 0;

  std::uint64_t samples_ = 0;  ///< since first_ns_
  core::TimeNs first_ns_ = 0;
  core::TimeNs last_ns_ = 0;
  std::uint64_t scans_ = 0;  ///< scan starts since first_scan_ns_, inclusive
  core::TimeNs first_scan_ns_ = 0;
  core::TimeNs last_scan_ns_ = 0;

  core::TripleBuffer<LidarStatus> latest_;
  /// About a dozen retries; the reader polls more often.
  static constexpr std::size_t kChanges = 64;
  core::RingBuffer<LidarChange> changes_{kChanges};
};

/// Passes samples on, counts them for the status, detects scans without returns, and foresees the
/// end of a scan.
class SampleMonitor : public SampleSink {
 public:
  SampleMonitor(SampleSink& next, StatusBoard& board) : next_(next), board_(board) {}

  void on_sample(const core::Sample& sample) override;
  void on_arrival(core::TimeNs arrival_ns) override {
    arrival_ns_ = arrival_ns;
    next_.on_arrival(arrival_ns);
  }
  void on_gap() override;

  /// kDeadLaser: 20 scans in a row had returns for less than 1 % of their samples. kNoScan: no scan
  /// has begun for 3 s.
  LidarFault fault() const;

  /// How long bytes may be collected from `now_ns` on: for long within a scan, since only its end
  /// gives a pose; briefly where the end is due.
  std::chrono::milliseconds collecting_time(core::TimeNs now_ns) const;

 private:
  void end_scan();
  void time_scan(core::TimeNs start_ns);

  SampleSink& next_;
  StatusBoard& board_;
  std::size_t scan_samples_ = 0;
  std::size_t scan_returns_ = 0;
  int empty_scans_ = 0;
  core::TimeNs last_ns_ = 0;               ///< of the newest sample
  std::optional<core::TimeNs> turned_ns_;  ///< the newest start of a scan, or the first sample
  core::TimeNs arrival_ns_ = 0;            ///< of the next start of a scan; 0: not known
  core::TimeNs scan_start_ns_ = 0;
  core::TimeNs scan_arrival_ns_ = 0;   ///< a sample of a capsule arrives 8 to 20 ms after its time
  core::TimeNs scan_duration_ns_ = 0;  ///< of the last whole scan; 0 if there is none
};

}  // namespace cornerd::drivers
