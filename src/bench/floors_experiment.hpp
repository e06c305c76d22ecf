// SPDX-License-Identifier: MIT
// Ten maps of one kind, and drives in one of them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/map/wall_map.hpp"

namespace cornerd::bench {

/// A drive is in one of the first `taken_in` maps.
struct MapSet {
  std::string title;
  std::vector<std::shared_ptr<const core::WallMap>> maps;
  std::size_t taken_in = 0;
  double furnished = 0;  ///< share of the rays that stop at what no map has
};

/// Floors of an office building: in each some walls are missing and some stand elsewhere; the same
/// with furniture. Twice the same floor among eight others. Flats; in the last set all maps are of
/// other flats than the drives'.
std::vector<MapSet> map_sets(std::uint64_t seed);

/// Of drives with core::MapChoice.
struct FloorScore {
  std::size_t starts = 0;
  std::size_t right = 0;
  std::size_t wrong = 0;          ///< a map is named, and it is not the drive's nor its copy
  std::size_t ambiguous = 0;      ///< several maps to the end, with the drive's
  std::size_t without_truth = 0;  ///< several, without the drive's
  std::size_t none = 0;
  std::vector<double> scans;     ///< until the right map was named, of each such drive
  std::vector<double> driven_m;  ///< likewise
  std::size_t poses = 0;         ///< in the right map
  std::size_t lost_poses = 0;    ///< of these without a pose
  std::size_t wrong_poses = 0;   ///< of these off by 10 cm or 5 degrees
};

/// Drives of 25 s at 0.4 m/s from a random place. Ends a second after a map is named.
FloorScore run_map_set(const MapSet& set, std::size_t starts, std::uint64_t seed,
                       const std::function<void(std::size_t done)>& done);

}  // namespace cornerd::bench
