// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "core/map/wall_map.hpp"
#include "replay/simulator/simulated_recording.hpp"
#include "tool/error_statistics.hpp"

namespace cornerd {

/// As many turns as `config` has, one at each of that many random places of `building`, through a
/// recording's bytes, each localized in `map` without a prior.
tool::ErrorStatistics localize_random_places(std::shared_ptr<const core::WallMap> building,
                                             std::shared_ptr<const core::WallMap> map,
                                             const replay::SimulatedRecordingConfig& config);

}  // namespace cornerd
