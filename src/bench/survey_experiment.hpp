// SPDX-License-Identifier: MIT
// A simulated drive through a known building, surveyed, and a second one localized in the result.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bench/simulated_drive.hpp"
#include "bench/survey_scoring.hpp"
#include "core/map/wall_map.hpp"
#include "survey/survey.hpp"

namespace cornerd::bench {

/// The drive that the odometry was measured on: all rooms of config/maps/flat-7.json, wheels 1.5
/// and 2.5 % larger than configured, the gyro 2 % and 0.01 rad/s off, 0.4 m/s.
SimulatedDrive survey_drive(std::shared_ptr<const core::WallMap> map, std::size_t scans,
                            std::uint64_t seed, bool has_odometry = true);

/// Turns of that drive that are 100 m.
inline constexpr std::size_t kSurveyScans = 2600;

struct LocalizationScore {
  std::size_t scans = 0;
  std::size_t named = 0;  ///< a place
  std::size_t wrong = 0;  ///< over 10 cm or 5 degrees off
  double mean_error_m = 0;
  double error_95_m = 0;
};

/// The daemon's localizer on a drive, without odometry. `T_true_map`: of the map's frame.
LocalizationScore localize_drive(std::shared_ptr<const core::WallMap> map,
                                 const SimulatedDrive& drive, const core::Pose2& T_true_map);

struct SurveyCase {
  std::string title;
  survey::SurveyResult result;
  double cpu_s = 0;
  SurveyScore score;
  std::optional<LocalizationScore> second_drive;  ///< none in a map that is no map
};

struct SurveyExperiment {
  std::vector<SurveyCase> cases;
  LocalizationScore in_true_map;  ///< the same second drive
  double way_m = 0;
};

/// Ours with odometry and without, and the paper's way: with the odometry as it is, and with what
/// ours learned of it.
SurveyExperiment run_survey_experiment(std::shared_ptr<const core::WallMap> map, std::size_t scans,
                                       std::uint64_t seed);

/// Once and a third around ring_corridor(), 65 m, with a lidar that sees 4 m far, so that 9 m of
/// the bare side show nothing of the way along it. Wheels 1.5 and 2.5 % larger than configured, a
/// gyro 2 % and 0.01 rad/s off; three times in ten metres one wheel slips for a fifth of a second.
SimulatedDrive ring_drive(std::uint64_t seed, bool has_odometry = true);

/// In and out of four rooms that are equal to the millimetre, and back, with the same robot.
SimulatedDrive equal_rooms_drive(std::uint64_t seed);

struct LoopCase {
  survey::SurveyResult result;
  SurveyScore score;
  double worst_m = 0;  ///< of the way, from where it began
};

LoopCase survey_loop(const core::WallMap& map, const SimulatedDrive& drive, bool close_loops);

}  // namespace cornerd::bench
