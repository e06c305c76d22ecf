// SPDX-License-Identifier: MIT
#include "drawn_map.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <optional>
#include <random>

namespace cornerd::gridmap {
namespace {

using core::Vec2;

constexpr double kMarginCells = 8;

DrawnMap blank(const core::WallMap& map, double resolution_m, double yaw_rad) {
  const Vec2 low = map.lower_left();
  const Vec2 high = map.upper_right();
  const core::Pose2 rotation{0, 0, yaw_rad};
  Vec2 near = Vec2::Constant(1e9);
  Vec2 far = -near;
  for (const Vec2& corner : {low, high, Vec2(low.x(), high.y()), Vec2(high.x(), low.y())}) {
    const Vec2 turned = rotation.inverse() * corner;
    near = near.cwiseMin(turned);
    far = far.cwiseMax(turned);
  }
  // An arbitrary offset to the raster.
  const Vec2 margin = Vec2(kMarginCells + 0.37, kMarginCells + 0.21) * resolution_m;
  const Vec2 size = (far - near + 2 * margin) / resolution_m;
  const Vec2 origin = rotation * Vec2(near - margin);
  return {OccupancyGrid(static_cast<std::size_t>(size.x()), static_cast<std::size_t>(size.y())),
          resolution_m,
          {origin.x(), origin.y(), yaw_rad}};
}

bool is_within(const core::WallMap& map, const Vec2& place) {
  return (place - map.lower_left()).minCoeff() > 0 && (map.upper_right() - place).minCoeff() > 0;
}

template <typename Visitor>
void for_each_cell(const DrawnMap& drawn, Visitor&& visit) {
  for (std::int64_t row = 0; row < drawn.grid.rows(); ++row) {
    for (std::int64_t column = 0; column < drawn.grid.columns(); ++column) {
      const Vec2 middle(static_cast<double>(column) + 0.5, static_cast<double>(row) + 0.5);
      visit(column, row, drawn.T_map_picture * Vec2(middle * drawn.resolution_m));
    }
  }
}

std::array<std::int64_t, 2> cell_of(const DrawnMap& drawn, const Vec2& place) {
  const Vec2 cell = drawn.to_cells(place);
  return {static_cast<std::int64_t>(std::floor(cell.x())),
          static_cast<std::int64_t>(std::floor(cell.y()))};
}

/// A mapper's counts in a cell.
struct Counts {
  int hits = 0;
  int passes = 0;
};

void trace_beam(const DrawnMap& drawn, const Vec2& from, double angle_rad, double range_m,
                std::vector<Counts>& counts) {
  const auto count = [&](const std::array<std::int64_t, 2>& cell) -> Counts& {
    return counts[static_cast<std::size_t>(cell[1] * drawn.grid.columns() + cell[0])];
  };
  const Vec2 ray = core::unit_vector(angle_rad);
  const auto last = cell_of(drawn, from + range_m * ray);
  std::optional<std::array<std::int64_t, 2>> passed;
  for (double s = 0; s < range_m; s += drawn.resolution_m / 4) {
    const auto cell = cell_of(drawn, from + s * ray);
    if (cell == last) break;
    if (cell == passed || !drawn.grid.holds(cell[0], cell[1])) continue;
    passed = cell;
    ++count(cell).passes;
  }
  if (drawn.grid.holds(last[0], last[1])) ++count(last).hits;
}

double distance_to(const core::Face& face, const Vec2& point) {
  const double along = std::clamp(face.direction.dot(point - face.from), 0.0, face.length_m);
  return (point - face.from - along * face.direction).norm();
}

/// Length of the faces of one map before free cells, and of that without like ones in the other.
std::array<double, 2> unmatched(const core::WallMap& of, const core::WallMap& in,
                                const DrawnMap& drawn) {
  const double step_m = drawn.resolution_m / 2;
  double seen_m = 0;
  double lost_m = 0;
  for (const core::Face& face : of.faces()) {
    if (face.length_m < 3 * drawn.resolution_m) continue;
    for (double s = step_m; s < face.length_m - step_m; s += step_m) {
      const Vec2 point = face.from + s * face.direction;
      if (!drawn.is_open(point, face.normal)) continue;
      seen_m += step_m;
      const auto faces = in.faces();
      const bool found = std::any_of(faces.begin(), faces.end(), [&](const core::Face& other) {
        return other.normal.dot(face.normal) > 0.9 &&
               distance_to(other, point) < 1.5 * drawn.resolution_m;
      });
      if (!found) lost_m += step_m;
    }
  }
  return {seen_m, lost_m};
}

}  // namespace

DrawnMap draw_map(const core::WallMap& map, double resolution_m, double yaw_rad) {
  DrawnMap drawn = blank(map, resolution_m, yaw_rad);
  for_each_cell(drawn, [&](std::int64_t column, std::int64_t row, const Vec2& middle) {
    if (!is_within(map, middle)) return;
    drawn.grid.set(column, row, map.is_solid(middle) ? Cell::kOccupied : Cell::kFree);
  });
  for (const core::Wall& wall : map.plan().walls) {
    const Vec2 direction = wall.to - wall.from;
    const double steps = std::ceil(direction.norm() / resolution_m * 10);
    for (double i = 0; i <= steps; ++i) {
      const auto cell = cell_of(drawn, wall.from + i / steps * direction);
      drawn.grid.set(cell[0], cell[1], Cell::kOccupied);
    }
  }
  return drawn;
}

/// Heading of the drift of a mapper's poses, rad for each metre of it.
constexpr double kDriftPerMetre = 0.1;

DrawnMap scan_map(const core::WallMap& map, double resolution_m, double yaw_rad, double sigma_m,
                  std::size_t places, double drift_m) {
  constexpr int kBeams = 720;
  DrawnMap drawn = blank(map, resolution_m, yaw_rad);
  std::vector<Counts> counts(static_cast<std::size_t>(drawn.grid.columns() * drawn.grid.rows()));
  std::mt19937_64 random(20193);
  std::normal_distribution<double> noise(0, sigma_m);
  std::mt19937_64 random_drift(20198);
  std::normal_distribution<double> drift(0, drift_m);
  const Vec2 size = map.upper_right() - map.lower_left();
  std::uniform_real_distribution<double> share(0, 1);
  for (std::size_t made = 0; made < places;) {
    const Vec2 place = map.lower_left() + size.cwiseProduct(Vec2(share(random), share(random)));
    // Not within a wall, nor within a robot's radius of one.
    bool is_near = map.is_solid(place);
    for (const core::Face& face : map.faces()) is_near = is_near || distance_to(face, place) < 0.1;
    if (is_near) continue;
    ++made;
    const Vec2 drawn_place = place + Vec2(drift(random_drift), drift(random_drift));
    const double turned_rad = kDriftPerMetre * drift(random_drift);
    for (int beam = 0; beam < kBeams; ++beam) {
      const double angle_rad = beam * core::kTwoPi / kBeams;
      const double range_m = map.range_along(place, angle_rad, 12);
      if (range_m == 0) continue;
      trace_beam(drawn, drawn_place, angle_rad + turned_rad, range_m + noise(random), counts);
    }
  }
  std::size_t i = 0;
  for_each_cell(drawn, [&](std::int64_t column, std::int64_t row, const Vec2&) {
    const Counts& count = counts[i++];
    const int visits = count.hits + count.passes;
    if (visits == 0) return;
    drawn.grid.set(column, row, 4 * count.hits > visits ? Cell::kOccupied : Cell::kFree);
  });
  return drawn;
}

std::string to_pgm(const OccupancyGrid& grid) {
  std::string bytes = "P5\n# a test\n" + std::to_string(grid.columns()) + " " +
                      std::to_string(grid.rows()) + "\n255\n";
  for (std::int64_t row = grid.rows() - 1; row >= 0; --row) {
    for (std::int64_t column = 0; column < grid.columns(); ++column) {
      const Cell cell = grid.at(column, row);
      bytes += cell == Cell::kFree ? '\xfe' : cell == Cell::kOccupied ? '\0' : '\xcd';
    }
  }
  return bytes;
}

std::string to_yaml(const DrawnMap& drawn, const std::string& image) {
  char text[300];
  std::snprintf(text, sizeof text,
                "image: %s\nresolution: %.6f\norigin: [%.6f, %.6f, %.6f]\nnegate: 0\n"
                "occupied_thresh: 0.65\nfree_thresh: 0.196\n",
                image.c_str(), drawn.resolution_m, drawn.T_map_picture.x_m, drawn.T_map_picture.y_m,
                drawn.T_map_picture.theta_rad);
  return text;
}

std::string ImportScore::text() const {
  char text[240];
  std::snprintf(text, sizeof text,
                "%3zu of %3zu corners, median %5.1f mm, max %5.1f mm, %2zu invented; of %5.1f m "
                "%4.2f m missed, %4.2f m invented",
                corner_errors_m.size(), corners, 1000 * median_m(), 1000 * max_m(),
                invented_corners, faces_m, missed_m, invented_m);
  return text;
}

ImportScore score_import(const core::WallMap& truth, const core::WallMap& imported,
                         const DrawnMap& drawn) {
  ImportScore score;
  const double reach_m = 2.5 * drawn.resolution_m;
  const auto faces_free = [&](const core::Corner& corner) {
    return drawn.is_open(corner.position, 1.4 * core::unit_vector(corner.bisector_rad()));
  };
  const auto is_like = [](const core::Corner& a, const core::Corner& b) {
    return std::abs(a.opening_rad - b.opening_rad) < 0.5 &&
           std::abs(core::angle_between(a.bisector_rad(), b.bisector_rad())) < 0.5;
  };
  const auto nearest = [&](const core::Corner& corner, const core::WallMap& map) {
    double nearest_m = 1e9;
    for (const core::Corner& other : map.corners()) {
      if (!is_like(corner, other)) continue;
      nearest_m = std::min(nearest_m, (other.position - corner.position).norm());
    }
    return nearest_m;
  };
  for (const core::Corner& corner : truth.corners()) {
    if (!faces_free(corner)) continue;
    ++score.corners;
    const double error_m = nearest(corner, imported);
    if (error_m < reach_m) score.corner_errors_m.push_back(error_m);
  }
  std::sort(score.corner_errors_m.begin(), score.corner_errors_m.end());
  for (const core::Corner& corner : imported.corners()) {
    if (faces_free(corner) && nearest(corner, truth) > reach_m) ++score.invented_corners;
  }
  const auto [faces_m, missed_m] = unmatched(truth, imported, drawn);
  score.faces_m = faces_m;
  score.missed_m = missed_m;
  score.invented_m = unmatched(imported, truth, drawn)[1];
  return score;
}

}  // namespace cornerd::gridmap
