// SPDX-License-Identifier: MIT
// Surveys a simulated drive through a known building, and localizes a second drive in the result.
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

/// miscalibrated_robot() through all rooms of config/maps/flat-7.json at 0.4 m/s.
SimulatedDrive survey_drive(std::shared_ptr<const core::WallMap> map, std::size_t scans,
                            std::uint64_t seed, bool has_odometry = true);

/// Scans of 100 m of that drive.
inline constexpr std::size_t kSurveyScans = 2600;

struct LocalizationScore {
  std::size_t scans = 0;
  std::size_t named = 0;  ///< fix or tracking
  std::size_t wrong = 0;  ///< over 10 cm or 5 degrees off
  double mean_error_m = 0;
  double error_95_m = 0;
};

/// Localizes a drive without odometry. `T_true_map`: the map's frame in the true one.
LocalizationScore localize_drive(std::shared_ptr<const core::WallMap> map,
                                 const SimulatedDrive& drive, const core::Pose2& T_true_map);

struct SurveyCase {
  std::string title;
  survey::SurveyResult result;
  double cpu_s = 0;
  SurveyScore score;
  std::optional<LocalizationScore> second_drive;  ///< none where the map has too many corners
};

struct SurveyExperiment {
  std::vector<SurveyCase> cases;
  LocalizationScore in_true_map;  ///< the same second drive
  double length_m = 0;
};

/// survey() with and without odometry; ransac_survey() with the odometry as configured, and with
/// the parameters that survey() estimated.
SurveyExperiment run_survey_experiment(std::shared_ptr<const core::WallMap> map, std::size_t scans,
                                       std::uint64_t seed);

/// One and a third rounds of ring_corridor(), 65 m, with a lidar of 4 m range: 9 m of the bare side
/// show nothing along the corridor. miscalibrated_robot() with three slips of a fifth of a second
/// in ten metres.
SimulatedDrive ring_drive(std::uint64_t seed, bool has_odometry = true);

/// In and out of four identical rooms, and back, with the same robot.
SimulatedDrive equal_rooms_drive(std::uint64_t seed);

struct LoopCase {
  survey::SurveyResult result;
  SurveyScore score;
  double worst_m = 0;  ///< of the trajectory, relative to its start
};

LoopCase survey_loop(const core::WallMap& map, const SimulatedDrive& drive, bool close_loops);

}  // namespace cornerd::bench
