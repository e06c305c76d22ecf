// SPDX-License-Identifier: MIT
#include "tool/map/map_warnings.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <numeric>
#include <optional>
#include <utility>

#include "core/map/crossings.hpp"
#include "core/map/polygon.hpp"
#include "settings/map_file.hpp"
#include "tool/drawing/text_table.hpp"

namespace cornerd::tool {

namespace {

using core::Vec2;

/// Drawings have millimetres: closer points are one.
constexpr double kSamePoint_m = 1e-3;
/// SET_POSE is refused as far outside of the map.
constexpr double kMaxOutside_m = 1;
/// Neighbours may each reach to the far side of the wall between them.
constexpr double kMaxSharedShare = 0.1;
/// Lattice over a room: its cells are a quarter of a percent of the room's box.
constexpr int kCellsPerSide = 20;
/// Lines of the report.
constexpr std::size_t kMaxWarnings = 12;

using Warnings = std::vector<std::string>;

std::string room_name(const core::Room& room, std::size_t index) {
  return "room " + std::to_string(index) + ", \"" + room.name + "\",";
}

void check_size(const core::WallMap& map, Warnings& warnings) {
  const std::string warning = settings::size_warning(map);
  if (!warning.empty()) warnings.push_back(warning);
}

void check_walls(const core::FloorPlan& plan, Warnings& warnings) {
  const auto millimetres = [](double metres) { return std::llround(metres / kSamePoint_m); };
  std::map<std::array<std::int64_t, 4>, std::size_t> walls;
  for (std::size_t i = 0; i < plan.walls.size(); ++i) {
    const core::Wall& wall = plan.walls[i];
    if ((wall.to - wall.from).norm() < kSamePoint_m) {
      warnings.push_back(
          formatted("wall %zu at (%.3f, %.3f) has no length: it stands as a square of its "
                    "thickness, %.3f m; remove it unless it is a pillar",
                    i, wall.from.x(), wall.from.y(), wall.thickness_m));
    }
    std::array<std::int64_t, 4> ends = {millimetres(wall.from.x()), millimetres(wall.from.y()),
                                        millimetres(wall.to.x()), millimetres(wall.to.y())};
    if (std::array{ends[2], ends[3]} < std::array{ends[0], ends[1]}) {
      std::swap(ends[0], ends[2]);
      std::swap(ends[1], ends[3]);
    }
    const auto [first, is_new] = walls.emplace(ends, i);
    if (is_new) continue;
    warnings.push_back(formatted(
        "wall %zu from (%.3f, %.3f) to (%.3f, %.3f) is a duplicate of wall %zu: remove one", i,
        wall.from.x(), wall.from.y(), wall.to.x(), wall.to.y(), first->second));
  }
}

bool crosses_itself(const std::vector<Vec2>& polygon) {
  std::vector<core::Face> edges;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    core::Face edge;
    edge.from = polygon[i];
    edge.to = polygon[(i + 1) % polygon.size()];
    edge.length_m = (edge.to - edge.from).norm();
    if (edge.length_m < kSamePoint_m) continue;
    edge.direction = (edge.to - edge.from) / edge.length_m;
    edge.normal = core::rotate_left(edge.direction);
    edge.offset_m = edge.normal.dot(edge.from);
    edges.push_back(edge);
  }
  return !core::crossings_of(edges, kSamePoint_m, 1).empty();
}

struct Box {
  Vec2 low;
  Vec2 high;
};

Box box_of(const core::Room& room) {
  Box box{room.polygon.front(), room.polygon.front()};
  for (const Vec2& point : room.polygon) {
    box.low = box.low.cwiseMin(point);
    box.high = box.high.cwiseMax(point);
  }
  return box;
}

/// Points of a lattice within the room.
std::vector<Vec2> lattice_of(const core::Room& room) {
  const Box box = box_of(room);
  const Vec2 step = (box.high - box.low) / kCellsPerSide;
  std::vector<Vec2> points;
  for (int row = 0; row < kCellsPerSide; ++row) {
    for (int column = 0; column < kCellsPerSide; ++column) {
      const Vec2 point = box.low + step.cwiseProduct(Vec2(column + 0.5, row + 0.5));
      if (core::contains(room.polygon, point)) points.push_back(point);
    }
  }
  return points;
}

/// A room may lie within another one that comes later: poses are named after the first.
bool lies_within(const core::Room& inner, const core::Room& outer) {
  const std::vector<Vec2> points = lattice_of(inner);
  const auto count = std::count_if(points.begin(), points.end(), [&](const Vec2& point) {
    return core::contains(outer.polygon, point);
  });
  return static_cast<double>(count) >= (1 - kMaxSharedShare) * static_cast<double>(points.size());
}

void check_overlaps(const core::WallMap& map, std::size_t index, const std::vector<Vec2>& points,
                    Warnings& warnings) {
  const std::vector<core::Room>& rooms = map.plan().rooms;
  std::map<std::size_t, std::size_t> shared;  // points, by the room that comes first
  for (const Vec2& point : points) {
    const std::optional<std::size_t> first = map.room_at(point);
    if (first && *first < index) ++shared[*first];
  }
  for (const auto& [other, count] : shared) {
    const double share = static_cast<double>(count) / static_cast<double>(points.size());
    if (share <= kMaxSharedShare || (share < 1 && lies_within(rooms[other], rooms[index]))) {
      continue;
    }
    warnings.push_back(
        room_name(rooms[index], index) + formatted(" lies to %.0f %% within ", 100 * share) +
        room_name(rooms[other], other) + " after which poses there are named: draw them apart");
  }
}

void check_room(const core::WallMap& map, std::size_t index, Warnings& warnings) {
  const core::Room& room = map.plan().rooms[index];
  const std::string name = room_name(room, index);
  if (crosses_itself(room.polygon)) {
    warnings.push_back(name + " crosses itself like a bow-tie: list its corners in order, around");
  }
  const Box box = box_of(room);
  const double outside_m =
      std::max((map.lower_left() - box.low).maxCoeff(), (box.high - map.upper_right()).maxCoeff());
  if (outside_m > kMaxOutside_m) {
    warnings.push_back(
        name +
        formatted(" reaches %.1f m beyond all walls: move it, or draw its walls", outside_m));
  }
  const std::vector<Vec2> points = lattice_of(room);
  if (points.empty()) return;
  check_overlaps(map, index, points, warnings);
  const Vec2 centre = std::accumulate(points.begin(), points.end(), Vec2(0, 0)) /
                      static_cast<double>(points.size());
  if (map.is_solid(centre)) {
    warnings.push_back(name + formatted(" has its centre (%.2f, %.2f) inside a wall or furniture: "
                                        "check that wall's thickness and the room's corners",
                                        centre.x(), centre.y()));
  }
}

}  // namespace

std::vector<std::string> map_warnings(const core::WallMap& map) {
  Warnings warnings;
  check_size(map, warnings);
  check_walls(map.plan(), warnings);
  for (std::size_t i = 0; i < map.plan().rooms.size(); ++i) check_room(map, i, warnings);
  return warnings;
}

std::string describe_warnings(const std::vector<std::string>& warnings) {
  std::string text;
  for (std::size_t i = 0; i < std::min(warnings.size(), kMaxWarnings); ++i) {
    text += "warning  " + warnings[i] + "\n";
  }
  if (warnings.size() > kMaxWarnings) {
    text += formatted("warning  and %zu more\n", warnings.size() - kMaxWarnings);
  }
  return text;
}

}  // namespace cornerd::tool
