// SPDX-License-Identifier: MIT
#include "core/catalog/catalog.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace cornerd::core {
namespace {

constexpr double kBin_m = 0.01;

/// True where nothing stands between two points in the free space. Both are pulled a little into
/// their corner's opening, off the walls that they belong to.
bool in_sight(const WallMap& map, const Corner& a, const Corner& b) {
  constexpr double kOffWall_m = 1e-3;
  const Vec2 from = a.position + kOffWall_m * unit_vector(a.bisector_rad());
  const Vec2 to = b.position + kOffWall_m * unit_vector(b.bisector_rad());
  const Vec2 way = to - from;
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
  collect_pairs(map, reach_m);
  index_pairs();
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

void Catalog::collect_pairs(const WallMap& map, double reach_m) {
  for (std::uint32_t a = 0; a < landmarks_.size(); ++a) {
    for (std::uint32_t b = a + 1; b < landmarks_.size(); ++b) {
      const double distance_m = (landmarks_[a].position - landmarks_[b].position).norm();
      if (distance_m > reach_m || !in_sight(map, landmarks_[a], landmarks_[b])) continue;
      pairs_.push_back({distance_m, a, b});
    }
  }
  std::sort(pairs_.begin(), pairs_.end(), [](const LandmarkPair& p, const LandmarkPair& q) {
    return p.distance_m < q.distance_m;
  });
}

void Catalog::index_pairs() {
  const double longest_m = pairs_.empty() ? 0 : pairs_.back().distance_m;
  const auto bins = static_cast<std::size_t>(longest_m / kBin_m) + 2;
  first_pair_.assign(bins, static_cast<std::uint32_t>(pairs_.size()));
  for (std::size_t i = pairs_.size(); i-- > 0;) {
    first_pair_[static_cast<std::size_t>(pairs_[i].distance_m / kBin_m)] =
        static_cast<std::uint32_t>(i);
  }
  for (std::size_t bin = bins - 1; bin-- > 0;) {
    first_pair_[bin] = std::min(first_pair_[bin], first_pair_[bin + 1]);
  }
}

std::span<const LandmarkPair> Catalog::pairs_between(double low_m, double high_m) const {
  const auto bin = static_cast<std::size_t>(std::max(0.0, low_m) / kBin_m);
  if (pairs_.empty() || bin >= first_pair_.size()) return {};
  std::size_t begin = first_pair_[bin];
  while (begin < pairs_.size() && pairs_[begin].distance_m < low_m) ++begin;
  std::size_t end = begin;
  while (end < pairs_.size() && pairs_[end].distance_m <= high_m) ++end;
  return std::span(pairs_).subspan(begin, end - begin);
}

}  // namespace cornerd::core
