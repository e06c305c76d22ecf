// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "core/map/wall_map.hpp"

namespace cornerd::core {

/// Pairs of faces that cross between their ends, by more than `end_m` from each, ascending. Of
/// faces that all cross in one point only one pair is given. The search ends
/// where it has `max_pairs`, of which some may be equal and the order is any.
std::vector<std::pair<std::uint32_t, std::uint32_t>> crossings_of(std::span<const Face> faces,
                                                                  double end_m,
                                                                  std::size_t max_pairs);

}  // namespace cornerd::core
