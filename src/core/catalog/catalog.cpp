// SPDX-License-Identifier: MIT
#include "core/catalog/catalog.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "core/map/sight.hpp"

namespace cornerd::core {
namespace {

constexpr double kOffWall_m = 1e-3;

/// A landmark's place, pulled a little into its opening, off the walls that it belongs to.
Vec2 off_wall(const Corner& landmark) {
  return landmark.position + kOffWall_m * unit_vector(landmark.bisector_rad());
}

/// True where nothing stands between two landmarks.
bool in_sight(const WallMap& map, const Corner& a, const Corner& b) {
  const Vec2 from = off_wall(a);
  const Vec2 way = off_wall(b) - from;
  const double distance_m = way.norm();
  if (distance_m < kOffWall_m) return false;
  const double range_m =
      map.range_along(from, std::atan2(way.y(), way.x()), distance_m + kOffWall_m);
  return range_m == 0 || range_m > distance_m - kOffWall_m;
}

}  // namespace

Catalog::Catalog(const WallMap& map, double reach_m)
    : landmarks_(map.corners().begin(), map.corners().end()) {
  index_places(map);
  const std::vector<LandmarkPair> pairs = pairs_in_sight(map, reach_m);
  pairs_ = PairIndex(landmarks_, pairs);
  list_neighbours(pairs);
}

void Catalog::index_places(const WallMap& map) {
  constexpr double kUsualCell_m = 0.25;
  constexpr double kMaxCells = 1e6;
  lower_left_ = map.lower_left();
  const Vec2 size = map.upper_right() - map.lower_left();
  cell_m_ = std::max(kUsualCell_m, std::sqrt(size.x() * size.y() / kMaxCells));
  columns_ = static_cast<std::size_t>(size.x() / cell_m_) + 1;
  rows_ = static_cast<std::size_t>(size.y() / cell_m_) + 1;

  const auto cell = [&](const Corner& landmark) {
    return row_of(landmark.position.y()) * columns_ + column_of(landmark.position.x());
  };
  in_cells_.resize(landmarks_.size());
  std::iota(in_cells_.begin(), in_cells_.end(), 0U);
  std::stable_sort(in_cells_.begin(), in_cells_.end(), [&](std::uint32_t a, std::uint32_t b) {
    return cell(landmarks_[a]) < cell(landmarks_[b]);
  });
  first_in_cell_.assign(columns_ * rows_ + 1, 0);
  for (const Corner& landmark : landmarks_) ++first_in_cell_[cell(landmark) + 1];
  std::partial_sum(first_in_cell_.begin(), first_in_cell_.end(), first_in_cell_.begin());
}

std::vector<LandmarkPair> Catalog::pairs_in_sight(const WallMap& map, double reach_m) const {
  struct Other {
    double distance_m;
    std::uint32_t index;
  };
  const std::size_t most = std::clamp<std::size_t>(
      kMaxPairs / std::max<std::size_t>(1, landmarks_.size()), 4, kMaxNeighbours);
  Sight sight;
  std::vector<Other> others;
  std::vector<LandmarkPair> pairs;
  for (std::uint32_t i = 0; i < landmarks_.size(); ++i) {
    const Corner& landmark = landmarks_[i];
    sight.look(map, off_wall(landmark), reach_m + kOffWall_m,
               [](std::uint32_t, const FaceInSight&) {});
    others.clear();
    const double farthest_m = std::min(reach_m, sight.horizon().farthest_m() + 2 * kOffWall_m);
    visit_within(landmark.position, farthest_m, [&](std::uint32_t j) {
      const Vec2 way = landmarks_[j].position - landmark.position;
      const double distance_m = way.norm();
      if (j == i || distance_m > reach_m || !sight.horizon().may_see(way, 3 * kOffWall_m)) return;
      others.push_back({distance_m, j});
    });
    std::sort(others.begin(), others.end(), [](const Other& a, const Other& b) {
      return a.distance_m != b.distance_m ? a.distance_m < b.distance_m : a.index < b.index;
    });
    std::size_t found = 0;
    for (const Other& other : others) {
      if (!in_sight(map, landmark, landmarks_[other.index])) continue;
      pairs.push_back({std::min(i, other.index), std::max(i, other.index),
                       static_cast<float>(other.distance_m)});
      if (++found == most) break;
    }
  }
  // Most were found from both ends.
  const auto ends = [](const LandmarkPair& pair) { return std::pair(pair.from, pair.to); };
  std::sort(pairs.begin(), pairs.end(),
            [&](const LandmarkPair& a, const LandmarkPair& b) { return ends(a) < ends(b); });
  pairs.erase(
      std::unique(pairs.begin(), pairs.end(),
                  [&](const LandmarkPair& a, const LandmarkPair& b) { return ends(a) == ends(b); }),
      pairs.end());
  return pairs;
}

void Catalog::list_neighbours(std::span<const LandmarkPair> pairs) {
  first_neighbour_.assign(landmarks_.size() + 1, 0);
  for (const LandmarkPair& pair : pairs) {
    ++first_neighbour_[pair.from + 1];
    ++first_neighbour_[pair.to + 1];
  }
  std::partial_sum(first_neighbour_.begin(), first_neighbour_.end(), first_neighbour_.begin());
  neighbours_.resize(first_neighbour_.back());
  std::vector<std::uint32_t> next(first_neighbour_.begin(), first_neighbour_.end() - 1);
  for (const LandmarkPair& pair : pairs) {
    neighbours_[next[pair.from]++] = pair;
    neighbours_[next[pair.to]++] = {pair.to, pair.from, pair.distance_m};
  }
  for (std::size_t i = 0; i < landmarks_.size(); ++i) {
    std::sort(neighbours_.begin() + first_neighbour_[i],
              neighbours_.begin() + first_neighbour_[i + 1],
              [](const LandmarkPair& a, const LandmarkPair& b) {
                return a.distance_m != b.distance_m ? a.distance_m < b.distance_m : a.to < b.to;
              });
  }
}

std::size_t Catalog::memory_bytes() const {
  return landmarks_.capacity() * sizeof(Corner) + pairs_.memory_bytes() +
         neighbours_.capacity() * sizeof(LandmarkPair) +
         (first_neighbour_.capacity() + first_in_cell_.capacity() + in_cells_.capacity()) *
             sizeof(std::uint32_t);
}

}  // namespace cornerd::core
