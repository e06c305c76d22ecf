// SPDX-License-Identifier: MIT
// Start here, with survey.cpp: from a recorded drive to a map and the robot's trajectory.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "core/localizer_config.hpp"
#include "core/map/wall_map.hpp"
#include "survey/face_merging.hpp"
#include "survey/loop_closure.hpp"
#include "survey/recorded_drive.hpp"
#include "survey/rejected_odometry.hpp"
#include "survey/survey_progress.hpp"
#include "survey/validity_checks.hpp"

namespace cornerd::survey {

struct SurveyConfig {
  core::LocalizerConfig sensor;  ///< limits of the range, mount, noise, detector, odometry
  MergeLimits merging;
  WallLimits walls;
  bool close_loops = true;  ///< false: for comparison
  bool manhattan = false;   ///< makes walls square that are so within their sigma
};

/// Part of a wall that no ray ended on: extended to a corner, or across a gap.
struct ThinPlace {
  core::Vec2 from;
  core::Vec2 to;
};

/// Wall faces that --manhattan made square, and those it did not.
struct SquaredSides {
  std::size_t square = 0;
  std::size_t askew = 0;  ///< left as measured
};

struct SurveyResult {
  core::FloorPlan plan;                 ///< frame: the robot at the middle of the first scan
  std::vector<core::Pose2> T_map_base;  ///< at the middle of each scan
  std::vector<core::TimeNs> t_ns;
  std::vector<core::Vec2> points;  ///< some of the returns, on the map
  std::vector<ThinPlace> thin;
  std::vector<DroppedPiece> dropped;
  std::vector<std::size_t> unmatched_scans;  ///< scan matching found no pose
  /// Without odometry: the walls leave one direction unobservable, which was extrapolated.
  std::vector<std::size_t> degenerate_scans;
  std::vector<LoopReport> loops;            ///< closed and rejected loop closures
  double duplicate_m = 0;                   ///< of walls, behind others that would have hidden them
  FreeSpaceConflicts free_space_conflicts;  ///< what rays ended on and others went through
  std::size_t discarded_faces = 0;
  std::size_t merged_faces = 0;
  std::size_t observations = 0;
  std::size_t outliers = 0;
  double sigma = 0;           ///< of the residuals, in their sigmas
  bool has_odometry = false;  ///< of wheels
  bool has_gyro = false;
  /// Set where the recorded odometry was rejected and the map is by the lidar alone.
  std::optional<RejectedOdometry> rejected_odometry;
  std::optional<SquaredSides> squared;
  std::optional<core::OdometryParameters> learned;
};

/// Transforms the result into another frame; `T_new_map` is the pose of the first scan in it.
void move_frame(const core::Pose2& T_new_map, SurveyResult& result);

/// Surveys a drive. Odometry that is missing, or inconsistent with the lidar, in more than a tenth
/// of the scans is left out. Throws std::invalid_argument, with the reason, where the drive gives
/// no map: no walls, or a validity check fails.
SurveyResult survey(const RecordedDrive& drive, const SurveyConfig& config,
                    const SurveyProgress& progress = {});

}  // namespace cornerd::survey
