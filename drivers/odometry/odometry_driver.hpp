// SPDX-License-Identifier: MIT
// The interface of odometry sensors on the board itself.
#pragma once

#include <cstdint>
#include <stop_token>
#include <string_view>

#include "core/odometry/odometry_reading.hpp"
#include "drivers/lidar_status.hpp"

namespace cornerd::drivers {

enum class SensorState : std::uint8_t {
  kNone,        ///< not configured
  kAbsent,      ///< no device of that name
  kUnreadable,  ///< reading fails: rights, a bus error, another reader
  kDisabled,    ///< not set up to count
  kInvalid,     ///< the attribute holds no number
  kStuck,       ///< constant although the other sensors report motion
  kRunning,
};

std::string_view to_string(SensorState state);

struct SensorStatus {
  SensorState state = SensorState::kNone;
  ShortText detail;  ///< for a person: what is wrong, where, what to do
};

struct OdometryCounters {
  std::uint64_t readings = 0;        ///< delivered
  std::uint64_t failed_reads = 0;    ///< of an attribute
  std::uint64_t invalid_values = 0;  ///< attributes that held no number
  std::uint64_t wraps = 0;           ///< of counts at their ceiling or zero
  std::uint64_t late = 0;            ///< pairs of counts read too far apart
};

struct OdometryStatus {
  SensorStatus left;
  SensorStatus right;
  SensorStatus gyro;
  OdometryCounters counters;
};

/// Receives readings on the driver's thread.
class OdometrySink {
 public:
  virtual ~OdometrySink() = default;
  virtual void on_reading(const core::OdometryReading& reading) = 0;
};

class OdometryDriver {
 public:
  virtual ~OdometryDriver() = default;

  /// Delivers readings with monotonic times until a stop is requested. Never throws; device faults
  /// are states, and missing devices are searched for again.
  virtual void run(std::stop_token stop, OdometrySink& sink) = 0;

  /// The newest status. For one thread; never blocks run().
  virtual OdometryStatus status() = 0;
};

}  // namespace cornerd::drivers
