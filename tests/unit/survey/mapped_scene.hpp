// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "survey/drive_mapper.hpp"

namespace cornerd::survey {

/// A wall face as a lidar at the pose observes it, without noise. Free space is on the left of the
/// direction from `from` to `to`.
LineObservation observation_of(const core::Vec2& from, const core::Vec2& to,
                               const core::Pose2& T_map_lidar);

/// A face with 20 observations from the map's origin.
LineLandmark face_between(const core::Vec2& from, const core::Vec2& to);

/// Faces by their ends, and a scan for each pose that observes all faces towards it.
MappedDrive mapped_drive(std::span<const std::pair<core::Vec2, core::Vec2>> walls,
                         std::span<const core::Pose2> poses);

/// Gives each scan the returns of 720 rays among the faces, without noise.
void add_returns(MappedDrive& drive);

}  // namespace cornerd::survey
