// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "core/map/wall_map.hpp"

namespace cornerd::bench {

/// What became of a robot that was picked up and put elsewhere, again and again.
struct KidnappingScore {
  static constexpr std::size_t kScans = 6;  ///< at each place

  std::size_t jumps = 0;
  /// Jumps after which the first right fix came with the first turn, the second, ...
  std::array<std::size_t, kScans> recovered{};
  std::size_t never = 0;        ///< not within kScans
  std::size_t wrong_first = 0;  ///< turns right after a jump that named a wrong place
  std::size_t wrong_later = 0;  ///< later turns that did
};

/// `jumps` of them, shared by the maps; usual noise, 800 samples a turn.
KidnappingScore run_kidnapping(const std::vector<std::shared_ptr<const core::WallMap>>& maps,
                               std::size_t jumps, std::uint64_t seed,
                               const std::function<void(std::size_t done)>& progress = {});

}  // namespace cornerd::bench
