// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "survey/drive_mapper.hpp"

namespace cornerd::survey {

/// A wall's side as a lidar at the pose sees it, without noise: free space on the left of the way.
Sighting sighting_of(const core::Vec2& from, const core::Vec2& to, const core::Pose2& T_map_lidar);

/// A face that was seen so from the map's origin, often.
MappedFace face_between(const core::Vec2& from, const core::Vec2& to);

/// Faces by their ends, and a turn for each of the poses that sees all of those that look at it.
MappedDrive mapped_drive(std::span<const std::pair<core::Vec2, core::Vec2>> walls,
                         std::span<const core::Pose2> poses);

/// Gives each turn the returns of a lidar of 720 rays among the faces, without noise.
void add_returns(MappedDrive& drive);

}  // namespace cornerd::survey
