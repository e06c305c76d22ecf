// SPDX-License-Identifier: MIT
// Error and consistency of poses predicted by odometry while the lidar is covered.
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

/// A drive through the rooms of config/maps/flat-7.json whose lidar is covered periodically.
struct CoveredLidarCase {
  std::string_view title;
  replay::RobotModel robot;
  replay::SensorModel lidar;
  double first_cover_s = 30;   ///< from the start to the first cover
  double cover_period_s = 12;  ///< from one cover's start to the next one's
  double cover_duration_s = 5;
  double duration_s = 300;
  /// Each drive has random robot errors, drawn from core::OdometryNoise.
  bool draws_errors = false;
  std::size_t drive_factor = 1;  ///< multiplies the number of drives, for short ones
};

/// Error of poses and consistency of their covariance.
struct PoseConsistency {
  std::size_t poses = 0;
  double mean_m = 0;
  double worst_m = 0;
  double worst_rad = 0;
  double mean_nees = 0;     ///< normalised estimation error squared; 3 for an exact covariance
  double share_within = 0;  ///< share with NEES below kNees95; 0.95 for an exact covariance
};

/// Predicted poses of one range of ages.
struct AgeConsistency : PoseConsistency {
  double from_s = 0;
  double to_s = 0;
};

struct CoveredLidarResult {
  PoseConsistency fixes;
  /// By age; the first range is that between two scans.
  std::array<AgeConsistency, 4> predicted;
};

/// miscalibrated_robot() and variants: more noise, slip, no gyro, coarse encoders, a biased lidar.
std::vector<CoveredLidarCase> covered_lidar_cases();

/// Scores a prediction for every odometry reading (publish_predictions). Deterministic.
CoveredLidarResult run_covered_lidar_case(std::shared_ptr<const core::WallMap> map,
                                          const CoveredLidarCase& test_case, std::uint64_t seed,
                                          std::size_t drives);

}  // namespace cornerd::bench
