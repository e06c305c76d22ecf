// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <memory>

#include "core/map/wall_map.hpp"
#include "replay/simulator/simulated_recording.hpp"
#include "tool/replay/error_statistics.hpp"

namespace cornerd {

/// As many turns as `config` has, so many at each random place of `building`, through a recording's
/// bytes, localized in `map`: where there is one at each, without a prior.
tool::ErrorStatistics localize_random_places(std::shared_ptr<const core::WallMap> building,
                                             std::shared_ptr<const core::WallMap> map,
                                             const replay::SimulatedRecordingConfig& config,
                                             std::size_t scans_each = 1);

}  // namespace cornerd
