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

/// Recovery of a robot that is put elsewhere again and again.
struct KidnappingScore {
  static constexpr std::size_t kScans = 6;  ///< at each pose

  std::size_t jumps = 0;
  /// Jumps whose first correct fix came with the first scan, the second, ...
  std::array<std::size_t, kScans> recovered{};
  std::size_t never = 0;        ///< not within kScans
  std::size_t wrong_first = 0;  ///< wrong poses in the first scan after a jump
  std::size_t wrong_later = 0;  ///< wrong poses in later scans
};

/// Divides `jumps` among the maps; default noise, 800 samples a scan.
KidnappingScore run_kidnapping(const std::vector<std::shared_ptr<const core::WallMap>>& maps,
                               std::size_t jumps, std::uint64_t seed,
                               const std::function<void(std::size_t done)>& progress = {});

}  // namespace cornerd::bench
