// SPDX-License-Identifier: MIT
// From a drawn plan and a survey to the plan with each wall where it is.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "core/localizer_config.hpp"
#include "core/map/wall_map.hpp"
#include "survey/recorded_drive.hpp"
#include "survey/survey.hpp"

namespace cornerd::survey {

/// A wall of the plan, or a part of one.
struct PlanPart {
  std::size_t wall = 0;  ///< index into the drawn plan's walls
  core::Vec2 from;
  core::Vec2 to;
};

struct RefinedPlan {
  core::FloorPlan plan;          ///< name, rooms and order of the drawn one; new walls at the end
  std::vector<double> moved_m;   ///< across, at its middle: of each wall that was seen
  std::vector<PlanPart> unseen;  ///< kept as drawn
  /// Open space: rays went through to a wall beyond. Left out of the plan.
  std::vector<PlanPart> contradicted;
  std::vector<core::Wall> added;
};

/// Moves each wall of a drawn plan to the surveyed faces along it. Walls that meet in the plan meet
/// afterwards. Each wall is fitted by least squares over its offset, angle and thickness, with the
/// plan as prior. `surveyed`: in the plan's frame. `places`: where the lidar was; `returns`: what
/// it saw, in the plan's frame. Source of the figures: src/survey/README.md;
/// tests/unit/survey/plan_refinement_test.cpp.
RefinedPlan refine_plan(const core::FloorPlan& drawn, const core::WallMap& surveyed,
                        std::span<const core::Vec2> places, std::span<const core::Vec2> returns);

/// Moves a survey into the frame of a drawn plan and replaces its walls by refine_plan()'s. Throws
/// std::invalid_argument where the drive does not fit the plan.
RefinedPlan refine_to_plan(const RecordedDrive& drive, const core::LocalizerConfig& sensor,
                           const std::shared_ptr<const core::WallMap>& drawn, SurveyResult& result);

}  // namespace cornerd::survey
