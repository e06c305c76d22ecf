// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <span>

#include "core/localizer_config.hpp"
#include "core/map/wall_map.hpp"
#include "survey/recorded_drive.hpp"

namespace cornerd::survey {

/// Pose of the survey's frame in the frame of a drawn plan: the drive is localized in the plan, and
/// most of its scans have to agree within kAgreeing_m on where the surveyed trajectory lies.
/// `T_survey_base`: of each scan. Throws std::invalid_argument, with the reason, where they do not.
core::Pose2 align_to_plan(const RecordedDrive& drive, std::span<const core::Pose2> T_survey_base,
                          std::shared_ptr<const core::WallMap> plan,
                          const core::LocalizerConfig& sensor);

/// The same pose, fitted to walls: least squares over the distances of the surveyed faces' ends to
/// the drawn faces, Cauchy weights. `T_plan_survey`: within a few decimetres.
core::Pose2 fit_to_walls(const core::Pose2& T_plan_survey, const core::WallMap& surveyed,
                         const core::WallMap& plan);

}  // namespace cornerd::survey
