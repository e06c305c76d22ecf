// SPDX-License-Identifier: MIT
#include "tool/map/map_difference.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

#include <nlohmann/json.hpp>

#include "core/map/cell_grid.hpp"
#include "core/map/outline.hpp"
#include "tool/drawing/text_table.hpp"

namespace cornerd::tool {

namespace {

using core::FloorPlan;
using core::Vec2;
using core::Wall;
using core::WallBox;

constexpr double kParallel_rad = core::radians(3);
/// Of a wall's length, that the other map has.
constexpr double kSameShare = 0.5;

/// The part of a wall, from its middle, that another one covers.
struct Overlap {
  std::size_t other = 0;
  double begin_m = 0;
  double end_m = 0;
  double other_begin_m = 0;  ///< where the other wall ends
  double other_end_m = 0;
  double across_m = 0;  ///< in the middle of the overlap
};

std::optional<Overlap> overlap_of(const WallBox& wall, const WallBox& other, double reach_m) {
  const double sine = core::cross(wall.along, other.along);
  if (std::abs(sine) > kParallel_rad) return std::nullopt;
  const Vec2 centre = wall.to_local(other.centre);
  const double cosine = std::abs(wall.along.dot(other.along));
  Overlap overlap;
  overlap.other_begin_m = centre.x() - other.half_length_m * cosine;
  overlap.other_end_m = centre.x() + other.half_length_m * cosine;
  overlap.begin_m = std::max(-wall.half_length_m, overlap.other_begin_m);
  overlap.end_m = std::min(wall.half_length_m, overlap.other_end_m);
  if (overlap.begin_m >= overlap.end_m) return std::nullopt;
  const double slope = sine / wall.along.dot(other.along);
  overlap.across_m = centre.y() + slope * ((overlap.begin_m + overlap.end_m) / 2 - centre.x());
  if (std::abs(overlap.across_m) > reach_m) return std::nullopt;
  return overlap;
}

/// What a wall is in the other map.
struct Counterpart {
  double share = 0;  ///< of its length
  std::optional<Overlap> largest;
  double begin_m = 0;  ///< of all walls that cover it, from its middle
  double end_m = 0;
};

class Walls {
 public:
  Walls(const FloorPlan& plan, double reach_m) : reach_m_(reach_m) {
    std::vector<core::Extent> extents;
    for (const Wall& wall : plan.walls) {
      boxes_.emplace_back(wall);
      WallBox wide = boxes_.back();
      wide.half_width_m += reach_m;
      extents.push_back(wide.extent());
    }
    grid_ = core::CellGrid(extents);
  }

  const WallBox& box(std::size_t wall) const { return boxes_[wall]; }

  Counterpart find(const WallBox& wall) const {
    const Vec2 half = wall.half_length_m * wall.along;
    std::vector<std::uint32_t> near;
    grid_.collect(core::Extent::of_segment(wall.centre - half, wall.centre + half, 0), near);
    std::vector<Overlap> overlaps;
    for (const std::uint32_t i : near) {
      auto overlap = overlap_of(wall, boxes_[i], reach_m_);
      if (!overlap) continue;
      overlap->other = i;
      overlaps.push_back(*overlap);
    }
    return joined(wall, std::move(overlaps));
  }

 private:
  static Counterpart joined(const WallBox& wall, std::vector<Overlap> overlaps) {
    Counterpart result;
    if (overlaps.empty()) return result;
    result.largest =
        *std::max_element(overlaps.begin(), overlaps.end(), [](const Overlap& a, const Overlap& b) {
          const double lead_m = (a.end_m - a.begin_m) - (b.end_m - b.begin_m);
          return lead_m != 0 ? lead_m < 0 : std::abs(a.across_m) > std::abs(b.across_m);
        });
    std::sort(overlaps.begin(), overlaps.end(),
              [](const Overlap& a, const Overlap& b) { return a.begin_m < b.begin_m; });
    double covered_m = 0;
    double reached_m = -wall.half_length_m;
    result.begin_m = overlaps.front().other_begin_m;
    result.end_m = overlaps.front().other_end_m;
    for (const Overlap& overlap : overlaps) {
      covered_m += std::max(0.0, overlap.end_m - std::max(reached_m, overlap.begin_m));
      reached_m = std::max(reached_m, overlap.end_m);
      result.begin_m = std::min(result.begin_m, overlap.other_begin_m);
      result.end_m = std::max(result.end_m, overlap.other_end_m);
    }
    result.share = covered_m / (2 * wall.half_length_m);
    return result;
  }

  double reach_m_;
  std::vector<WallBox> boxes_;
  core::CellGrid grid_;
};

std::optional<MovedWall> moved_wall(const WallBox& wall, const WallBox& other,
                                    const Counterpart& counterpart,
                                    const DifferenceOptions& options) {
  MovedWall moved;
  moved.other_wall = counterpart.largest->other;
  moved.across_m = counterpart.largest->across_m;
  moved.thicker_m = 2 * (other.half_width_m - wall.half_width_m);
  // Half a thickness of the box's length is its square end.
  const double square_m = other.half_width_m - wall.half_width_m;
  const auto set_ends = [&](double begin_m, double end_m) {
    moved.from_along_m = begin_m + wall.half_length_m + square_m;
    moved.to_along_m = end_m - wall.half_length_m - square_m;
    return std::max({std::abs(moved.across_m), std::abs(moved.from_along_m),
                     std::abs(moved.to_along_m), std::abs(moved.thicker_m)});
  };
  // The same wall, whatever continues it.
  const Overlap& alone = *counterpart.largest;
  if (set_ends(alone.other_begin_m, alone.other_end_m) <= options.tolerance_m) return std::nullopt;
  set_ends(counterpart.begin_m, counterpart.end_m);
  // What is further away is another wall that continues this one.
  for (double* end_m : {&moved.from_along_m, &moved.to_along_m}) {
    if (std::abs(*end_m) > options.reach_m) *end_m = 0;
  }
  const double largest_m = std::max({std::abs(moved.across_m), std::abs(moved.from_along_m),
                                     std::abs(moved.to_along_m), std::abs(moved.thicker_m)});
  if (largest_m <= options.tolerance_m) return std::nullopt;
  return moved;
}

std::string ends_text(const Wall& wall) {
  return formatted("from (%.3f, %.3f) to (%.3f, %.3f)", wall.from.x(), wall.from.y(), wall.to.x(),
                   wall.to.y());
}

nlohmann::ordered_json wall_json(std::size_t index, const Wall& wall) {
  return {{"wall", index},
          {"from", {wall.from.x(), wall.from.y()}},
          {"to", {wall.to.x(), wall.to.y()}}};
}

}  // namespace

MapDifference compare_maps(const FloorPlan& a, const FloorPlan& b,
                           const DifferenceOptions& options) {
  const Walls walls_a(a, options.reach_m);
  const Walls walls_b(b, options.reach_m);
  MapDifference difference;
  for (std::size_t i = 0; i < a.walls.size(); ++i) {
    const Counterpart counterpart = walls_b.find(walls_a.box(i));
    if (counterpart.share < kSameShare) {
      difference.gone.push_back(i);
    } else if (auto moved = moved_wall(walls_a.box(i), walls_b.box(counterpart.largest->other),
                                       counterpart, options)) {
      moved->wall = i;
      difference.moved.push_back(*moved);
    }
  }
  for (std::size_t i = 0; i < b.walls.size(); ++i) {
    if (walls_a.find(walls_b.box(i)).share < kSameShare) difference.added.push_back(i);
  }
  return difference;
}

std::string difference_text(const FloorPlan& a, const FloorPlan& b,
                            const MapDifference& difference) {
  std::string text = formatted("%zu moved, %zu gone, %zu new\n", difference.moved.size(),
                               difference.gone.size(), difference.added.size());
  for (const MovedWall& moved : difference.moved) {
    text += formatted("moved    wall %zu ", moved.wall) + ends_text(a.walls[moved.wall]) +
            formatted(": across %+.3f m, ends %+.3f and %+.3f m, thickness %+.3f m\n",
                      moved.across_m, moved.from_along_m, moved.to_along_m, moved.thicker_m);
  }
  for (const std::size_t i : difference.gone) {
    text += formatted("gone     wall %zu ", i) + ends_text(a.walls[i]) + "\n";
  }
  for (const std::size_t i : difference.added) {
    text += formatted("new      wall %zu ", i) + ends_text(b.walls[i]) + "\n";
  }
  return text;
}

std::string difference_json(const FloorPlan& a, const FloorPlan& b,
                            const MapDifference& difference) {
  nlohmann::ordered_json document = {{"moved", nlohmann::ordered_json::array()},
                                     {"gone", nlohmann::ordered_json::array()},
                                     {"new", nlohmann::ordered_json::array()}};
  for (const MovedWall& moved : difference.moved) {
    nlohmann::ordered_json wall = wall_json(moved.wall, a.walls[moved.wall]);
    wall.update({{"other_wall", moved.other_wall},
                 {"across", moved.across_m},
                 {"from_along", moved.from_along_m},
                 {"to_along", moved.to_along_m},
                 {"thicker", moved.thicker_m}});
    document["moved"].push_back(std::move(wall));
  }
  for (const std::size_t i : difference.gone) document["gone"].push_back(wall_json(i, a.walls[i]));
  for (const std::size_t i : difference.added) document["new"].push_back(wall_json(i, b.walls[i]));
  return document.dump(2) + "\n";
}

}  // namespace cornerd::tool
