// SPDX-License-Identifier: MIT
#include "core/catalog/catalog.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

#include "core/map/visible_faces.hpp"

namespace cornerd::core {
namespace {

constexpr double kWallOffset_m = 1e-3;
/// Where this near to a landmark there are as many others as are kept, they are many everywhere.
constexpr double kCrowd_m = 0.5;

/// The landmark's position, moved into its opening, off its own walls.
Vec2 off_wall(const Corner& landmark) {
  return landmark.position + kWallOffset_m * unit_vector(landmark.bisector_rad());
}

/// True where no wall stands between two landmarks.
bool is_visible(const WallMap& map, const Corner& a, const Corner& b) {
  const Vec2 from = off_wall(a);
  const Vec2 displacement = off_wall(b) - from;
  const double distance_m = displacement.norm();
  if (distance_m < kWallOffset_m) return false;
  const double range_m = map.range_along(from, std::atan2(displacement.y(), displacement.x()),
                                         distance_m + kWallOffset_m);
  return range_m == 0 || range_m > distance_m - kWallOffset_m;
}

/// Where walls fan out there are more corners than a lidar resolves, and all are in sight of each
/// other: the first kMaxCrowded of each square of 0.1 m.
std::vector<Corner> without_crowds(std::span<const Corner> corners) {
  constexpr double kSquare_m = Catalog::kVisitRadius_m;
  std::map<std::pair<double, double>, std::size_t> found;
  std::vector<Corner> kept;
  for (const Corner& corner : corners) {
    const Vec2 square = (corner.position / kSquare_m).array().floor();
    if (++found[{square.x(), square.y()}] <= Catalog::kMaxCrowded) kept.push_back(corner);
  }
  return kept;
}

}  // namespace

Catalog::Catalog(const WallMap& map, double max_distance_m)
    : landmarks_(without_crowds(map.corners())) {
  index_landmarks(map);
  const std::vector<LandmarkPair> pairs = visible_pairs(map, max_distance_m);
  pairs_ = PairIndex(landmarks_, pairs);
  list_neighbours(pairs);
}

void Catalog::index_landmarks(const WallMap& map) {
  constexpr double kMinCell_m = 0.25;
  constexpr double kMaxCells = 1e6;
  lower_left_ = map.lower_left();
  const Vec2 size = map.upper_right() - map.lower_left();
  cell_m_ = std::max(kMinCell_m, std::sqrt(size.x() * size.y() / kMaxCells));
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

std::vector<LandmarkPair> Catalog::visible_pairs(const WallMap& map, double max_distance_m) const {
  struct Candidate {
    double distance_m;
    std::uint32_t index;
  };
  const std::size_t max_pairs = std::clamp<std::size_t>(
      kMaxPairs / std::max<std::size_t>(1, landmarks_.size()), 4, kMaxNeighbours);
  VisibleFaces visible_faces;
  std::vector<Candidate> candidates;
  std::vector<LandmarkPair> pairs;
  const auto list = [&](std::uint32_t i, double radius_m, auto&& is_candidate) {
    candidates.clear();
    visit_within(landmarks_[i].position, radius_m, [&](std::uint32_t j) {
      const Vec2 displacement = landmarks_[j].position - landmarks_[i].position;
      const double distance_m = displacement.norm();
      if (j != i && is_candidate(displacement, distance_m)) candidates.push_back({distance_m, j});
    });
    std::sort(candidates.begin(), candidates.end(), [](const Candidate& a, const Candidate& b) {
      return a.distance_m != b.distance_m ? a.distance_m < b.distance_m : a.index < b.index;
    });
  };
  // True where as many are in sight as are kept.
  const auto add_visible = [&](std::uint32_t i) {
    std::size_t found = 0;
    for (const Candidate& candidate : candidates) {
      if (!is_visible(map, landmarks_[i], landmarks_[candidate.index])) continue;
      pairs.push_back({std::min(i, candidate.index), std::max(i, candidate.index),
                       static_cast<float>(candidate.distance_m)});
      if (++found == max_pairs) return true;
    }
    return false;
  };
  const double near_m = std::min(kCrowd_m, max_distance_m);
  for (std::uint32_t i = 0; i < landmarks_.size(); ++i) {
    // Where landmarks crowd, so do faces: those farther off are not looked at.
    list(i, near_m, [&](const Vec2&, double distance_m) { return distance_m <= near_m; });
    if (candidates.size() >= max_pairs && add_visible(i)) continue;
    visible_faces.find(map, off_wall(landmarks_[i]), max_distance_m + kWallOffset_m,
                       [](std::uint32_t, const VisibleFace&) {});
    const OcclusionBuffer& occlusion = visible_faces.occlusion();
    list(i, std::min(max_distance_m, occlusion.max_range_m() + 2 * kWallOffset_m),
         [&](const Vec2& displacement, double distance_m) {
           return distance_m <= max_distance_m &&
                  occlusion.may_be_visible(displacement, 3 * kWallOffset_m);
         });
    add_visible(i);
  }
  // Most pairs are found from both ends: keep each once.
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
