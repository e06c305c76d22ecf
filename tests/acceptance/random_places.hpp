// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <memory>

#include "core/map/wall_map.hpp"
#include "replay/simulator/simulated_recording.hpp"
#include "tool/replay/error_statistics.hpp"

namespace cornerd {

/// Localizes `config`'s number of scans at each random place of `building`, through a recording's
/// bytes, in `map`; without a prior where there is one scan per place.
tool::ErrorStatistics localize_random_places(std::shared_ptr<const core::WallMap> building,
                                             std::shared_ptr<const core::WallMap> map,
                                             const replay::SimulatedRecordingConfig& config,
                                             std::size_t scans_each = 1);

}  // namespace cornerd
