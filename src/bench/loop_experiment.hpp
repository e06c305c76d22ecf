// SPDX-License-Identifier: MIT
// Drives that come back to where they were, with odometry that slips: what loop closing is for.
#pragma once

#include <cstddef>
#include <cstdint>

#include "bench/simulated_drive.hpp"
#include "bench/survey_scoring.hpp"
#include "core/map/wall_map.hpp"
#include "survey/survey.hpp"

namespace cornerd::bench {

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
