// SPDX-License-Identifier: MIT
// What the daemon asks of a lidar, be it a device on a port or a recording that stands in for one.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <stop_token>
#include <string_view>

#include "core/lateness.hpp"
#include "core/odometry/odometry_reading.hpp"
#include "core/ring_buffer.hpp"
#include "core/types.hpp"
#include "drivers/lidar_fault.hpp"

namespace cornerd::drivers {

enum class LidarState : std::uint8_t {
  kAbsent,       ///< no such port
  kOpening,      ///< the port is there and cannot be opened yet: rights, or another process
  kIdentifying,  ///< asking who it is and how it feels
  kStarting,     ///< motor on, scan asked for, no data yet
  kRunning,
  kFaulty,   ///< answers, but cannot measure: its own health error, or a dead stream
  kBackoff,  ///< waiting before the next try
  kEnded,    ///< a recording has been played to its end
};

std::string_view to_string(LidarState state);

/// Short text of fixed size, so that a status can cross threads without a lock or an allocation.
struct ShortText {
  std::array<char, 240> chars{};
  std::string_view view() const;
  void set(std::string_view text);  ///< cut where it is longer
};

/// All that was thrown away on the way from bytes to samples, by cause, and what was kept.
struct StreamCounters {
  std::uint64_t bytes = 0;  ///< all that came; each ends up in used_bytes or in skipped_bytes
  std::uint64_t used_bytes = 0;
  std::uint64_t samples = 0;  ///< all that were decoded
  std::uint64_t scans = 0;
  std::uint64_t skipped_bytes = 0;      ///< belonged to no packet: banner, stale or damaged bytes
  std::uint64_t bad_checksums = 0;      ///< capsules whose checksum is wrong
  std::uint64_t lost_capsules = 0;      ///< holes seen in the capsules' start angles
  std::uint64_t bad_nodes = 0;          ///< standard nodes whose check bits are wrong
  std::uint64_t resyncs = 0;            ///< times that the packet boundary had to be found anew
  std::uint64_t unpaired_capsules = 0;  ///< capsules without the next one that their angles need
  std::uint64_t false_scan_starts = 0;  ///< start flags in the middle of a turn
  std::uint64_t clock_resets = 0;       ///< times that the sample clock had to be fitted anew
  std::uint64_t untimed_samples = 0;  ///< not delivered: when they were measured is not known (yet)
};

struct LidarStatus {
  LidarState state = LidarState::kAbsent;
  LidarFault fault = LidarFault::kNone;
  ShortText detail;  ///< for a person: what is wrong, what to do
  ShortText model;
  ShortText firmware;
  ShortText serial;  ///< number of the device, as its maker's tools print it
  ShortText health;
  ShortText mode;
  double rate_hz = 0;     ///< turns a second
  double samples_hz = 0;  ///< samples a second, empty ones too
  StreamCounters counters;
  /// How much later than could be the bytes of each packet were read: the driver's thread, and the
  /// way there.
  core::Lateness lateness;
};

/// Where a driver delivers. One driver, one sink, one thread.
class SampleSink {
 public:
  virtual ~SampleSink() = default;
  virtual void on_sample(const core::Sample& sample) = 0;
  /// The stream has a hole that the samples do not show: begin a new turn.
  virtual void on_gap() = 0;
  /// Of wheels and gyro: from recordings that hold both, among the samples of the same time.
  virtual void on_reading(const core::OdometryReading& /*reading*/) {}
  /// False while there is no room for another sample. A device cannot wait for it, a recording
  /// that is played as fast as it goes does.
  virtual bool ready() const { return true; }
};

/// A state that a driver has come to. Some last no longer than a few milliseconds.
struct LidarChange {
  LidarState state = LidarState::kAbsent;
  LidarFault fault = LidarFault::kNone;
  ShortText detail;
};

class LidarDriver {
 public:
  virtual ~LidarDriver() = default;

  /// Delivers samples until a stop is asked for or the source has ended. The reader thread's body:
  /// never throws; faults of the device are states, retried with back-off.
  virtual void run(std::stop_token stop, SampleSink& sink) = 0;

  /// The newest status. One reading thread at a time; never blocks run().
  virtual LidarStatus status() = 0;

  /// The next state that the driver came to, oldest first; false where there is none left. The same
  /// thread's as status().
  virtual bool take_change(LidarChange& change) = 0;

  /// Grows as long as run() is not stuck, whatever the device does. Any thread.
  std::uint32_t rounds() const { return rounds_.load(std::memory_order_relaxed); }

 protected:
  /// run() has come round.
  void come_round() { rounds_.fetch_add(1, std::memory_order_relaxed); }

 private:
  std::atomic<std::uint32_t> rounds_{0};
};

}  // namespace cornerd::drivers
