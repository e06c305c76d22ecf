// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <memory>

#include "core/map/wall_map.hpp"

namespace cornerd::bench {

inline constexpr std::size_t kMaxCountedScans = 60;

/// Localizes the first `scans` of kMaxCountedScans scans of 800 samples. All are simulated, so that
/// the difference of two runs is the localizer's cost alone. `tracking`: a robot on a small circle
/// at 0.2 m/s; else random poses, each scan without a prior.
void localize_scans(const std::shared_ptr<const core::WallMap>& map, std::size_t scans,
                    bool tracking);

}  // namespace cornerd::bench
