// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/localizer_config.hpp"
#include "survey/drive_mapper.hpp"
#include "survey/place_map.hpp"

namespace cornerd::survey {

/// A stretch of a drive that was recognised in the map of what was seen there long before.
struct Loop {
  std::vector<PlaceTie> ties;  ///< a turn each, in their order
  core::Pose2 T_now_then;      ///< how far off the drive is: of the middle tie's later turn
  std::size_t asked = 0;       ///< turns that the recogniser was asked for
  std::size_t recognised = 0;  ///< of those; the ties' are those that agree with one another
};

/// Turns in a row that are looked at together.
inline constexpr std::size_t kStretchScans = 60;

/// A shorter way is no loop: the walls on it are in view all along.
inline constexpr double kLeastLoop_m = 5;

/// Looks for places that a stretch of a drive, from turn `begin` on, came back to without the
/// matching having noticed: its turns see walls there as if they were new, but their corners are
/// recognised, without a prior, in the map of what the turns long before saw in the neighbourhood.
/// Several turns have to agree with what the drive knows of the way between them.
std::optional<Loop> find_loop(const MappedDrive& drive, std::size_t begin,
                              const core::LocalizerConfig& sensor, const WallLimits& limits);

}  // namespace cornerd::survey
