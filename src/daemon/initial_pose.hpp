// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "core/geometry/pose2.hpp"
#include "core/map/wall_map.hpp"
#include "message/request.hpp"

namespace cornerd::daemon {

/// The reason to refuse an initial pose that is more than a metre outside of the map's walls.
/// `map` may be null: any pose is accepted.
std::optional<message::RequestError> outside_of(const core::WallMap* map,
                                                const core::Pose2& T_map_base);

}  // namespace cornerd::daemon
