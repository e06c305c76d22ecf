// SPDX-License-Identifier: MIT
// What the daemon asks of wheels and gyro that hang on the board itself.
#pragma once

#include <cstdint>
#include <stop_token>
#include <string_view>

#include "core/odometry/odometry_reading.hpp"
#include "drivers/lidar_driver.hpp"

namespace cornerd::drivers {

enum class SensorState : std::uint8_t {
  kNone,        ///< not configured
  kAbsent,      ///< no device of that name, or it was taken away
  kUnreadable,  ///< it is there, and reading it fails: rights, a bus error, another reader
  kDisabled,    ///< it is there, and set up so that it does not count
  kGarbage,     ///< what it says is no number
  kFrozen,      ///< it says the same while the others say that the robot moves
  kRunning,
};

std::string_view to_string(SensorState state);

struct SensorStatus {
  SensorState state = SensorState::kNone;
  ShortText detail;  ///< for a person: what is wrong, what to do
};

struct OdometryCounters {
  std::uint64_t readings = 0;      ///< handed over
  std::uint64_t failed_reads = 0;  ///< of an attribute
  std::uint64_t garbage = 0;       ///< attributes that held no number
  std::uint64_t wraps = 0;         ///< counts that went over their ceiling or below zero
  std::uint64_t late = 0;          ///< pairs of counts read too far apart to belong together
};

struct OdometryStatus {
  SensorStatus left;
  SensorStatus right;
  SensorStatus gyro;
  OdometryCounters counters;
};

/// Where readings go. One driver, one sink, one thread.
class OdometrySink {
 public:
  virtual ~OdometrySink() = default;
  virtual void on_reading(const core::OdometryReading& reading) = 0;
};

class OdometryDriver {
 public:
  virtual ~OdometryDriver() = default;

  /// Delivers readings, their times monotonic, until a stop is asked for. Never throws; faults of
  /// the devices are states, and what is missing is looked for again.
  virtual void run(std::stop_token stop, OdometrySink& sink) = 0;

  /// The newest status. One reading thread at a time; never blocks run().
  virtual OdometryStatus status() = 0;
};

}  // namespace cornerd::drivers
