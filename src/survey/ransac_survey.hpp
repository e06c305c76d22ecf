// SPDX-License-Identifier: MIT
// Bertocco, Oliveira, Santos: Odometry and Feature Extraction (2019), sections II and V: points by
// dead reckoning, lines by RANSAC, split at gaps, merged where they are collinear and close.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/localizer_config.hpp"
#include "survey/recorded_drive.hpp"
#include "survey/survey.hpp"

namespace cornerd::survey {

/// The paper's thresholds are numbers of points (10,000 for a line, 1,000 for a run, of a million)
/// and a tenth of the farthest distance, which depend on the recording and the building. Here
/// points are first thinned to one per cell, so that counts become lengths.
struct RansacConfig {
  std::size_t iterations = 500;  ///< the paper shows 10, 50 and 100
  std::size_t returns = 180;     ///< per scan; the paper takes 10
  double cell_m = 0.02;
  double near_m = 0.03;     ///< inlier distance
  double min_line_m = 0.5;  ///< inliers of a line, times the cell
  double min_run_m = 0.2;   ///< the same without a gap
  double gap_m = 0.15;      ///< MAX_D
  double merge_rad = core::radians(5);
  double merge_m = 0.06;  ///< across; along: `gap_m`
  std::uint64_t seed = 1;
};

/// The paper's survey. Throws std::invalid_argument where there is no odometry, or no line.
SurveyResult ransac_survey(const RecordedDrive& drive, const core::LocalizerConfig& sensor,
                           const RansacConfig& config, const SurveyProgress& progress = {});

/// A drive by dead reckoning, beginning at the origin.
struct ReckonedDrive {
  std::vector<core::Pose2> T_map_base;  ///< at the middle of each scan
  std::vector<core::Vec2> points;       ///< returns, in the map
};

/// `returns`: kept of each scan, evenly. Throws std::invalid_argument where there is no odometry.
ReckonedDrive reckon_drive(const RecordedDrive& drive, const core::LocalizerConfig& sensor,
                           std::size_t returns);

/// The mean of the points in each cell that has at least a fifth of the mean number of points;
/// long drives leave stray returns in many cells.
std::vector<core::Vec2> thin_out(const std::vector<core::Vec2>& points, double cell_m);

}  // namespace cornerd::survey
