// SPDX-License-Identifier: MIT
#include "gridmap/face_corners.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>

#include "core/map/cell_grid.hpp"

namespace cornerd::gridmap {
namespace {

using core::Vec2;

/// Faces at a smaller angle (20 degrees) do not meet: their crossing is uncertain.
constexpr double kMinCrossingSine = 0.34;

class CornerJoiner {
 public:
  CornerJoiner(const OccupancyGrid& grid, std::vector<GridFace>& faces)
      : grid_(grid), faces_(faces), joined_(2 * faces.size(), false) {}

  /// Moves all ends that are not joined yet.
  void join(double reach, bool is_hidden) {
    std::vector<core::Extent> extents;
    for (const GridFace& face : faces_) {
      extents.push_back(core::Extent::of_segment(face.from, face.to, reach));
    }
    const core::CellGrid places(extents);
    std::vector<std::uint32_t> near;
    std::vector<GridFace> moved = faces_;
    std::vector<bool> joined = joined_;
    for (std::size_t end = 0; end < joined_.size(); ++end) {
      if (joined_[end]) continue;
      const Vec2 at = place(end);
      places.collect(core::Extent::of_segment(at, at, reach), near);
      const auto meeting = meet(end, near, reach, is_hidden);
      if (!meeting) continue;
      (end % 2 == 0 ? moved[end / 2].from : moved[end / 2].to) = *meeting;
      joined[end] = true;
    }
    faces_ = std::move(moved);
    joined_ = std::move(joined);
  }

 private:
  Vec2 place(std::size_t end) const {
    return end % 2 == 0 ? faces_[end / 2].from : faces_[end / 2].to;
  }

  /// The nearest crossing with another face, or with the extension of an end that is not joined.
  std::optional<Vec2> meet(std::size_t end, const std::vector<std::uint32_t>& near, double reach,
                           bool is_hidden) const {
    const GridFace& face = faces_[end / 2];
    const Vec2 at = place(end);
    const Vec2 outward = end % 2 == 0 ? Vec2(-face.direction) : face.direction;
    // At most half of a face is cut off, or it is doubled.
    const double most_cut = is_hidden ? 0 : std::min(reach, face.length() / 2);
    const double most_ahead = std::min(reach, face.length());
    std::optional<Vec2> meeting;
    double nearest = std::numeric_limits<double>::infinity();
    for (const std::uint32_t j : near) {
      const GridFace& other = faces_[j];
      const double sine = core::cross(outward, other.direction);
      if (std::abs(sine) < kMinCrossingSine) continue;
      const double ahead = core::cross(other.from - at, other.direction) / sine;
      if (ahead < -most_cut || ahead > most_ahead) continue;
      const Vec2 crossing = at + ahead * outward;
      const double along = other.along(crossing);
      const double beyond = std::max({0.0, -along, along - other.length()});
      const std::size_t other_end = 2 * j + (along > 0 ? 1 : 0);
      if (beyond > std::min(reach, other.length()) || (beyond > 0 && joined_[other_end])) continue;
      if (std::abs(ahead) + beyond >= nearest) continue;
      if (is_hidden &&
          (is_free(at, crossing) || (beyond > 0 && is_free(crossing, place(other_end))))) {
        continue;
      }
      nearest = std::abs(ahead) + beyond;
      meeting = crossing;
    }
    return meeting;
  }

  bool is_free(const Vec2& from, const Vec2& to) const {
    const double length = (to - from).norm();
    for (double s = 1; s < length; ++s) {
      if (grid_.at(Vec2(from + s / length * (to - from))) == Cell::kFree) return true;
    }
    return false;
  }

  const OccupancyGrid& grid_;
  std::vector<GridFace>& faces_;
  std::vector<bool> joined_;  ///< for each face, its from and its to
};

}  // namespace

void join_corners(const OccupancyGrid& grid, double reach, double hidden,
                  std::vector<GridFace>& faces) {
  CornerJoiner joiner(grid, faces);
  joiner.join(reach, false);
  joiner.join(std::max(reach, hidden), true);
}

}  // namespace cornerd::gridmap
