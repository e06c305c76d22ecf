// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "core/latency_histogram.hpp"

namespace cornerd::drivers {

struct LidarModel;

enum class LidarState : std::uint8_t {
  kAbsent,       ///< the port does not exist
  kOpening,      ///< the port exists but cannot be opened yet
  kIdentifying,  ///< GET_INFO and GET_HEALTH are being asked
  kStarting,     ///< the motor is on and the scan requested; no data yet
  kRunning,
  kFaulty,   ///< the device answers but cannot measure
  kBackoff,  ///< waiting before the next try
  kEnded,    ///< a recording has been played to its end
};

/// What keeps the daemon from getting measurements, as far as the host can observe it.
enum class LidarFault : std::uint8_t {
  kNone,
  kNoPort,          ///< no such file
  kNoPermission,    ///< this user may not open the port
  kPortBusy,        ///< another process has the port open
  kPortError,       ///< any other error of open()
  kUnplugged,       ///< the port vanished while it was open
  kStreamRunning,   ///< the device still measured for a program that never stopped it
  kUnexpectedData,  ///< bytes arrive unasked, and are no measurement
  kBooting,         ///< the device was just switched on: it prints its banner
  kNoAnswer,        ///< no request is answered
  kWrongBaud,       ///< noise instead of answers, or answers at the default speed
  kProtectionStop,  ///< health failed: laser and motor are off until a RESET
  kHealthError,     ///< health failed, and a RESET did not help
  kNoSuchMode,      ///< the device lacks the configured scan mode
  kMotorControl,    ///< the line that switches the motor cannot be set
  kNoData,          ///< a scan was requested, and no sample ever arrived
  kMotorStalled,    ///< samples arrived and then stopped
  kRestarted,       ///< the device printed its banner while it measured: its supply broke down
  kDeadLaser,       ///< samples arrive, and none has a return
  kNoScan,          ///< samples arrive, and make no revolution
};

std::string_view to_string(LidarState state);
/// As in STATUS, e.g. "motor-stalled"; empty for kNone.
std::string_view to_string(LidarFault fault);

/// Text of fixed size, so that a status crosses threads without a lock or an allocation.
struct ShortText {
  std::array<char, 240> chars{};
  std::string_view view() const;
  void set(std::string_view text);  ///< truncates
};

/// Bytes and samples kept and lost on the way from the port, by cause.
struct StreamCounters {
  std::uint64_t bytes = 0;  ///< all received; each is counted as used or skipped in the end
  std::uint64_t used_bytes = 0;
  std::uint64_t samples = 0;  ///< all decoded
  std::uint64_t scans = 0;
  std::uint64_t skipped_bytes = 0;      ///< part of no packet: banner, stale or damaged bytes
  std::uint64_t bad_checksums = 0;      ///< capsules
  std::uint64_t lost_capsules = 0;      ///< gaps between the capsules' start angles
  std::uint64_t bad_nodes = 0;          ///< standard nodes with wrong check bits
  std::uint64_t resyncs = 0;            ///< times that the packet boundary was lost
  std::uint64_t unpaired_capsules = 0;  ///< capsules without the successor that gives their angles
  std::uint64_t false_scan_starts = 0;  ///< start flags in the middle of a revolution
  std::uint64_t clock_resets = 0;       ///< times that the sample clock was fitted anew
  std::uint64_t untimed_samples = 0;    ///< not delivered, as their time is not known (yet)
};

/// A counter as STATUS names it.
struct CounterName {
  std::string_view name;
  std::uint64_t StreamCounters::*member;
};

inline constexpr std::array kCounterNames = {
    CounterName{"bytes", &StreamCounters::bytes},
    CounterName{"used_bytes", &StreamCounters::used_bytes},
    CounterName{"samples", &StreamCounters::samples},
    CounterName{"scans", &StreamCounters::scans},
    CounterName{"skipped_bytes", &StreamCounters::skipped_bytes},
    CounterName{"bad_checksums", &StreamCounters::bad_checksums},
    CounterName{"lost_capsules", &StreamCounters::lost_capsules},
    CounterName{"bad_nodes", &StreamCounters::bad_nodes},
    CounterName{"resyncs", &StreamCounters::resyncs},
    CounterName{"unpaired_capsules", &StreamCounters::unpaired_capsules},
    CounterName{"false_scan_starts", &StreamCounters::false_scan_starts},
    CounterName{"clock_resets", &StreamCounters::clock_resets},
    CounterName{"untimed_samples", &StreamCounters::untimed_samples},
};

static_assert(sizeof(StreamCounters) == kCounterNames.size() * sizeof(std::uint64_t),
              "every counter has a name");

StreamCounters& operator+=(StreamCounters& sum, const StreamCounters& more);

struct LidarStatus {
  LidarState state = LidarState::kAbsent;
  LidarFault fault = LidarFault::kNone;
  ShortText detail;  ///< for a person: what is wrong, where, what to do
  ShortText model;
  const LidarModel* known_model = nullptr;  ///< null where the device does not say which it is
  ShortText firmware;
  ShortText serial;  ///< as the vendor's tools print it
  ShortText health;
  ShortText mode;
  double rate_hz = 0;     ///< scans per second
  double samples_hz = 0;  ///< samples per second, those without a return included
  StreamCounters counters;
  /// Delay between the earliest possible arrival of a packet's bytes and their read.
  core::LatencyHistogram latency;
};

/// A state that a driver has entered; some last a few milliseconds.
struct LidarChange {
  LidarState state = LidarState::kAbsent;
  LidarFault fault = LidarFault::kNone;
  ShortText detail;
};

}  // namespace cornerd::drivers
