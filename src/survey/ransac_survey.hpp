// SPDX-License-Identifier: MIT
// Bertocco, Oliveira, Santos: Odometry and Feature Extraction (2019), sections II and V: points by
// odometry, lines by RANSAC, broken at gaps, merged where they are collinear and close.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "survey/survey.hpp"

namespace cornerd::survey {

/// The print counts points: 10,000 make a line and 1,000 in a row a piece of it, of the million
/// that its drive gave; and it takes a tenth of the distance of the farthest point for near. All of
/// that changes with the length of the recording and the size of the building. Here points are
/// thinned to one in a cell first, so that counts are lengths of wall, and near is a distance.
struct RansacConfig {
  std::size_t iterations = 500;  ///< the print shows 10, 50 and 100 of two points each
  std::size_t returns = 180;     ///< of a turn; the print takes 10 of a circling simulated lidar
  double cell_m = 0.02;
  double near_m = 0.03;       ///< of a line
  double least_line_m = 0.5;  ///< points of a line, times the cell
  double least_run_m = 0.2;   ///< the same without a gap
  double gap_m = 0.15;        ///< MAX_D
  double merge_rad = core::radians(5);
  double merge_m = 0.06;  ///< across; along: `gap_m`
  std::uint64_t seed = 1;
};

/// Where the odometry alone leads, and what RANSAC makes of the points. Throws
/// std::invalid_argument where there is no odometry, or no line.
SurveyResult ransac_survey(const RecordedDrive& drive, const core::LocalizerConfig& sensor,
                           const RansacConfig& config, const SurveyProgress& progress = {});

}  // namespace cornerd::survey
