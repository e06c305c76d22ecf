// SPDX-License-Identifier: MIT
// How far off poses are that wheels and gyro carry on without the lidar, and whether they know it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string_view>
#include <vector>

#include "core/map/wall_map.hpp"
#include "replay/simulator/sensor_model.hpp"
#include "replay/simulator/simulated_odometry.hpp"

namespace cornerd::bench {

/// A drive through the rooms of config/maps/flat-7.json, and when its lidar sees nothing.
struct CoveredLidarCase {
  std::string_view title;
  replay::RobotModel robot;
  replay::SensorModel lidar;
  double first_cover_s = 30;   ///< of driving until the lidar is covered for the first time
  double cover_period_s = 12;  ///< from then to the next time, and so on
  double cover_duration_s = 5;
  double duration_s = 300;
  /// Each drive has a robot of its own, with errors drawn from core::OdometryNoise.
  bool draws_errors = false;
  std::size_t drive_factor = 1;  ///< where they are short: so many instead of one
};

/// Poses against the truth, and what they say of their doubt.
struct PoseConsistency {
  std::size_t poses = 0;
  double mean_m = 0;
  double worst_m = 0;
  double worst_rad = 0;
  double mean_nees = 0;     ///< error squared in units of the covariance: 3 is exact
  double share_within = 0;  ///< of those whose NEES is under kNees95, 95 % of them if it is exact
};

/// Poses of one range of ages.
struct AgeConsistency : PoseConsistency {
  double from_s = 0;
  double to_s = 0;
};

struct CoveredLidarResult {
  PoseConsistency fixes;
  /// What lies between two turns, then the lidar covered.
  std::array<AgeConsistency, 4> predicted;
};

/// Robots that are as wrong as in the table of the modes, one that slips, and others.
std::vector<CoveredLidarCase> covered_lidar_cases();

/// A pose is carried on for every reading of the wheels (OdometryConfig::publish). Same input, same
/// result.
CoveredLidarResult run_covered_lidar_case(std::shared_ptr<const core::WallMap> map,
                                          const CoveredLidarCase& test_case, std::uint64_t seed,
                                          std::size_t drives);

}  // namespace cornerd::bench
