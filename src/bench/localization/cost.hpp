// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <memory>

#include "core/map/wall_map.hpp"

namespace cornerd::bench {

inline constexpr std::size_t kMaxCountedScans = 60;

/// Work whose instructions are counted: the first `turns` of kMaxCountedScans turns of 800 samples
/// are localized. All are simulated, so that what one number of turns costs more than another is
/// the localizer's work alone. Where `tracking`, of a robot that drives a small circle at 0.2 m/s;
/// else of one that stands at random places, each turn as if nothing had been known.
void localize_scans(const std::shared_ptr<const core::WallMap>& map, std::size_t scans,
                    bool tracking);

}  // namespace cornerd::bench
