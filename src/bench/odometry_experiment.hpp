// SPDX-License-Identifier: MIT
// Figures 3 to 6 of Bertocco et al. (2019) as ours: where the paper's four modes of odometry think
// that a robot is, after its two circuits and its exploration of a flat.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "calibration/drive_reckoning.hpp"
#include "calibration/factor_search.hpp"
#include "calibration/odometry_fit.hpp"
#include "core/geometry/pose2.hpp"
#include "core/odometry/dead_reckoning.hpp"
#include "replay/simulator/motion.hpp"
#include "replay/simulator/simulated_odometry.hpp"

namespace cornerd::bench {

struct OdometryRobot {
  std::string_view title;
  std::string_view name;  ///< in names of files
  replay::RobotModel model;
};

/// A Pioneer P3-DX and a robot of 16 cm, both as miscalibrated_robot(), a wheel slipping every 20
/// m.
std::vector<OdometryRobot> odometry_robots();

/// The paper's threshold tr, and how long its steps are that it holds for.
inline constexpr double kPaperDeadBand_rad = 0.01;
inline constexpr core::TimeNs kPaperStep_ns = core::kNsPerSecond / 10;

/// A drive as one way of reckoning has it.
struct ReckonedTrack {
  core::HeadingSource source = core::HeadingSource::kEncoder;  ///< kFilter: by least squares
  /// The paper's steps and dead band; else each reading is a step and nothing is left out.
  bool as_printed = false;
  std::optional<calibration::FoundFactors> factors;  ///< found on this very drive
  calibration::DriveError error;
  calibration::DrivePoints points;
};

struct OdometryResult {
  std::string_view scenario;
  double length_m = 0;
  std::vector<core::Vec2> truth;
  /// The modes without factors, then those that have any with them; first as printed, then without
  /// the dead band. Then least squares.
  std::vector<ReckonedTrack> tracks;
};

/// A robot drives the scenario once. Same input, same result.
OdometryResult run_odometry_case(const OdometryRobot& robot, const replay::Scenario& scenario,
                                 std::uint64_t seed);

}  // namespace cornerd::bench
