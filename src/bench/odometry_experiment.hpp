// SPDX-License-Identifier: MIT
// Figures 3 to 6 of Bertocco et al. (2019): trajectories of the paper's four odometry modes on two
// circuits and in the exploration of a flat.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "calibration/dead_reckoning.hpp"
#include "calibration/drive_reckoning.hpp"
#include "calibration/factor_search.hpp"
#include "calibration/odometry_fit.hpp"
#include "core/geometry/pose2.hpp"
#include "replay/simulator/motion.hpp"
#include "replay/simulator/simulated_odometry.hpp"

namespace cornerd::bench {

struct OdometryRobot {
  std::string_view title;
  std::string_view name;  ///< in file names
  replay::RobotModel model;
};

/// A Pioneer P3-DX and a robot with a track of 16 cm: miscalibrated_robot() with a slip every 20 m.
std::vector<OdometryRobot> odometry_robots();

/// The paper's threshold tr, and the step that it applies to.
inline constexpr double kPaperDeadBand_rad = 0.01;
inline constexpr core::TimeNs kPaperStep_ns = core::kNsPerSecond / 10;

/// The trajectory of one mode.
struct ReckonedTrack {
  calibration::HeadingSource source =
      calibration::HeadingSource::kEncoder;  ///< kFilter: by least squares
  /// With the paper's steps and dead band; otherwise each reading is a step, without a dead band.
  bool as_printed = false;
  std::optional<calibration::FoundFactors> factors;  ///< fitted to this drive
  calibration::DriveError error;
  calibration::DrivePoints points;
};

struct OdometryResult {
  std::string_view scenario;
  double length_m = 0;
  std::vector<core::Vec2> truth;
  /// The modes without factors, then with fitted factors; first as printed, then without the dead
  /// band. Least squares last.
  std::vector<ReckonedTrack> tracks;
};

/// Simulates one drive of the scenario. Deterministic.
OdometryResult run_odometry_case(const OdometryRobot& robot, const replay::Scenario& scenario,
                                 std::uint64_t seed);

}  // namespace cornerd::bench
