// SPDX-License-Identifier: MIT
// Odometry of robots, sensors, clocks and faults drawn at random, from ranges wider than those of
// the tests.
#pragma once

#include <cstdint>
#include <memory>
#include <string_view>

#include "core/map/wall_map.hpp"
#include "replay/simulator/simulated_odometry.hpp"

namespace cornerd::bench {

/// What a sensor or a clock does wrong from a random time on.
enum class OdometryFault : std::uint8_t {
  kNone,
  kWheelsSwapped,
  kLeftReversed,
  kGyroReversed,
  kGyroStuck,
  kGyroInDegrees,
  kLeftDead,
  kBothDead,
  kWrongCounts,
  kGyroMissing,
  kPauses,
  kClockStep,
  kTyreChanges,
  kCount
};
std::string_view name_of(OdometryFault fault);

struct RandomRobot {
  replay::RobotModel model;
  double speed_m_s = 0.4;
  double acceleration_m_s2 = 1;
  double yaw_acceleration_rad_s2 = 6;
  double lidar_offset_m = 0;
  double lidar_scale = 1;
  double delay_s = 0;    ///< of the time stamps
  double jitter_s = 0;   ///< of the time stamps, sigma
  double latency_s = 0;  ///< of the arrival: uniform up to this
  OdometryFault fault = OdometryFault::kNone;
  double fault_s = 0;  ///< its begin
  std::uint64_t seed = 0;
};

/// Deterministic.
RandomRobot draw_robot(std::uint64_t seed);

/// Mean normalised error squared of poses, 3 for an exact covariance.
struct MeanNees {
  double sum = 0;
  std::size_t poses = 0;
  void add(double nees) {
    sum += nees;
    ++poses;
  }
  double mean() const { return poses > 0 ? sum / static_cast<double>(poses) : 0; }
};

struct RandomRobotResult {
  MeanNees fixes;
  MeanNees predicted;  ///< one pose a cover, its last
  std::size_t covers = 0;
  std::size_t scans = 0;    ///< uncovered
  std::size_t named = 0;    ///< of these, fix or tracking
  std::size_t wrong = 0;    ///< named, more than 10 cm or 5 degrees off
  std::size_t silent = 0;   ///< predicted, as far off, and beyond 99.9 % of its covariance
  double worst_sigma2 = 0;  ///< largest NEES of a predicted pose
  double mean_error_m = 0;  ///< of the last pose of a cover
};

/// A drive of 250 s through config/maps/flat-7.json; after 20 s the lidar is covered for 4 s of
/// every 7 s. Deterministic.
RandomRobotResult run_random_robot(std::shared_ptr<const core::WallMap> map,
                                   const RandomRobot& robot);

}  // namespace cornerd::bench
