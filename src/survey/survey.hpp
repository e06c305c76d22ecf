// SPDX-License-Identifier: MIT
// THE FILE TO READ FIRST, with survey.cpp: a recorded drive in, a map and the way through it out.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "core/localizer_config.hpp"
#include "core/map/wall_map.hpp"
#include "survey/face_merging.hpp"
#include "survey/loop_closing.hpp"
#include "survey/odometry_doubt.hpp"
#include "survey/recorded_drive.hpp"
#include "survey/seen_through.hpp"
#include "survey/survey_progress.hpp"

namespace cornerd::survey {

struct SurveyConfig {
  core::LocalizerConfig sensor;  ///< limits of the range, mount, noise, detector, odometry
  MergeLimits merging;
  WallLimits walls;
  bool close_loops = true;  ///< false: to see what that does
  bool manhattan = false;   ///< walls that are square to the others within their doubt become so
};

/// Where the evidence for a wall is thin: of its length, the part that no ray ended on.
struct ThinPlace {
  core::Vec2 from;
  core::Vec2 to;
};

/// Sides of walls, of which --manhattan made some square.
struct SquaredSides {
  std::size_t square = 0;
  std::size_t askew = 0;  ///< left as they were seen
};

struct SurveyResult {
  core::FloorPlan plan;                 ///< frame: the robot in the middle of the first turn
  std::vector<core::Pose2> T_map_base;  ///< of each turn, at its middle
  std::vector<core::TimeNs> t_ns;
  std::vector<core::Vec2> points;  ///< some of the returns, on the map
  std::vector<ThinPlace> thin;
  std::vector<Dropped> dropped;
  std::vector<std::size_t> unmatched_scans;  ///< whose walls did not tell where they were
  /// Without odometry: whose walls told nothing of one direction, in which a guess stands.
  std::vector<std::size_t> degenerate_scans;
  std::vector<LoopReport> loops;  ///< places that were recognised again
  double doubled_m = 0;           ///< of walls, behind others that would have hidden them
  SeenThrough through;            ///< what rays ended on and others went through
  std::size_t forgotten_faces = 0;
  std::size_t merged_faces = 0;
  std::size_t observations = 0;
  std::size_t outliers = 0;
  double sigma = 0;           ///< of the residuals, in units of their doubts
  bool has_odometry = false;  ///< of wheels
  bool has_gyro = false;
  /// What the recorded odometry said, where it was not believed: the map is by the lidar alone.
  std::optional<OdometryDoubt> odometry_doubt;
  std::optional<SquaredSides> squared;
  std::optional<core::LearnedOdometry> learned;
};

/// The same map in another frame: `T_new_map` is where the robot was in the first turn.
void move_frame(const core::Pose2& T_new_map, SurveyResult& result);

/// Odometry that is missing or contradicts the lidar in more turns than slips explain is left out.
/// Throws std::invalid_argument, with the reason, where the drive gives no map: no walls, or turns
/// that do not overlap.
SurveyResult survey(const RecordedDrive& drive, const SurveyConfig& config,
                    const SurveyProgress& progress = {});

}  // namespace cornerd::survey
