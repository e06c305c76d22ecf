// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string_view>

#include "core/latest.hpp"
#include "core/ring_buffer.hpp"
#include "core/types.hpp"
#include "drivers/lidar_driver.hpp"

namespace cornerd::rplidar {

/// What a driver knows about its device, written by the reader thread, read by another one. Neither
/// ever waits, and nothing is allocated.
class StatusBoard {
 public:
  /// Reader thread, as all that follow but the last two.
  void set_state(drivers::LidarState state, drivers::LidarFault fault, std::string_view detail);
  void set_device(std::string_view model, std::string_view firmware, std::string_view serial);
  void set_health(std::string_view health);
  void set_mode(std::string_view mode);

  drivers::LidarState state() const { return status_.state; }
  drivers::LidarFault fault() const { return status_.fault; }
  std::string_view detail() const { return status_.detail.view(); }

  /// Bytes that came as answers, and beside them.
  void count_dialogue(std::uint64_t bytes, std::uint64_t used_bytes);

  /// Another stream begins; its counters go on top of those before.
  void begin_stream();
  /// A stream has ended: what is left of it is no packet any more.
  void end_stream(drivers::StreamCounters of_stream);
  void count(const core::Sample& sample);
  /// Publishes counters and rates, twice a second at most.
  void update(const drivers::StreamCounters& of_stream, const core::Lateness& lateness,
              core::TimeNs now_ns);

  /// The other thread.
  drivers::LidarStatus read() { return latest_.read(); }
  bool take_change(drivers::LidarChange& change) { return changes_.pop(change); }

 private:
  void publish() { latest_.publish(status_); }
  void measure_rates();

  drivers::LidarStatus status_;
  drivers::StreamCounters before_;  ///< of the streams that have ended
  core::TimeNs updated_ns_ = 0;

  std::uint64_t samples_ = 0;  ///< since first_ns_
  core::TimeNs first_ns_ = 0;
  core::TimeNs last_ns_ = 0;
  std::uint64_t scans_ = 0;  ///< turn marks since first_scan_ns_, that one included
  core::TimeNs first_scan_ns_ = 0;
  core::TimeNs last_scan_ns_ = 0;

  core::Latest<drivers::LidarStatus> latest_;
  /// A dozen of tries; whoever reads them comes by more often than that.
  static constexpr std::size_t kChanges = 64;
  core::RingBuffer<drivers::LidarChange> changes_{kChanges};
};

}  // namespace cornerd::rplidar
