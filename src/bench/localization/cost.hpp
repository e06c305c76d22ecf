// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <memory>

#include "core/map/wall_map.hpp"

namespace cornerd::bench {

/// Work whose instructions are counted: `turns` turns of 800 samples are localized. Where
/// `tracking`, of a robot that drives a small circle at 0.2 m/s; else of one that stands at random
/// places, each turn as if nothing had been known.
void localize_turns(const std::shared_ptr<const core::WallMap>& map, std::size_t turns,
                    bool tracking);

}  // namespace cornerd::bench
