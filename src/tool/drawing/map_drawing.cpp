// SPDX-License-Identifier: MIT
#include "tool/drawing/map_drawing.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <vector>

#include <Eigen/Eigenvalues>

namespace cornerd::tool {

namespace {

using core::Vec2;

constexpr double kPicturePx = 900;  // the longer side of the map, without its margin
constexpr double kMarginPx = 64;

constexpr std::string_view kLabel = "#8c867a";
constexpr std::string_view kConcave = "#2f6f9f";
constexpr std::string_view kConvex = "#d1813a";
constexpr std::string_view kReturn = "#1b9e77";
constexpr std::string_view kBreakpoint = "#c2255c";
constexpr std::string_view kRobot = "#c92a2a";
constexpr std::array<std::string_view, 6> kRoomTints = {"#eef4fa", "#f3f7ec", "#fdf4e7",
                                                        "#f7eef6", "#ecf6f4", "#faf0ee"};

double pixels_per_m(const core::WallMap& map) {
  const Vec2 size = map.upper_right() - map.lower_left();
  return kPicturePx / std::max(size.maxCoeff(), 1e-3);
}

/// The round length (1, 2 or 5 times a power of ten) that is nearest below `length`.
double round_below(double length) {
  const double power = std::pow(10, std::floor(std::log10(length)));
  for (const double factor : {5.0, 2.0}) {
    if (factor * power <= length) return factor * power;
  }
  return power;
}

std::string short_number(double value) {
  std::array<char, 32> digits{};
  const double rounded = std::round(value * 1000) / 1000;
  const auto end =
      std::to_chars(digits.data(), digits.data() + digits.size(), rounded == 0 ? 0.0 : rounded);
  return {digits.data(), end.ptr};
}

double area_of(std::span<const Vec2> polygon) {
  double area2 = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    area2 += core::cross(polygon[i], polygon[(i + 1) % polygon.size()]);
  }
  return std::abs(area2) / 2;
}

/// Centre of gravity of a polygon's area; the mean of its points where it has none.
Vec2 centroid(std::span<const Vec2> polygon) {
  Vec2 weighted = Vec2::Zero();
  Vec2 mean = Vec2::Zero();
  double area2 = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2& a = polygon[i];
    const Vec2& b = polygon[(i + 1) % polygon.size()];
    const double weight = core::cross(a, b);
    weighted += weight * (a + b) / 3;
    area2 += weight;
    mean += a / static_cast<double>(polygon.size());
  }
  return std::abs(area2) > 1e-9 ? Vec2(weighted / area2) : mean;
}

std::array<Vec2, 4> solid_of(const core::Wall& wall) {
  const Vec2 span = wall.to - wall.from;
  const Vec2 along = span.norm() > 0 ? Vec2(span.normalized()) : Vec2(Vec2::UnitX());
  const Vec2 ahead = along * wall.thickness_m / 2;
  const Vec2 left = core::rotate_left(ahead);
  return {wall.from - ahead - left, wall.to + ahead - left, wall.to + ahead + left,
          wall.from - ahead + left};
}

}  // namespace

MapDrawing::MapDrawing(const core::WallMap& map)
    : map_(map), svg_(map.lower_left(), map.upper_right(), pixels_per_m(map), kMarginPx) {
  const double size_m = (map.upper_right() - map.lower_left()).maxCoeff();
  draw_rooms();
  draw_grid(round_below(size_m / 5));
  draw_room_names();
  draw_walls();
  draw_corners();
  draw_scale_bar(round_below(size_m / 4));
}

void MapDrawing::draw_rooms() {
  // A room may lie within another one: the smaller on top.
  std::vector<const core::Room*> rooms;
  for (const core::Room& room : map_.plan().rooms) rooms.push_back(&room);
  std::stable_sort(rooms.begin(), rooms.end(), [](const auto* one, const auto* other) {
    return area_of(one->polygon) > area_of(other->polygon);
  });
  svg_.begin_group("rooms");
  for (std::size_t i = 0; i < rooms.size(); ++i) {
    svg_.polygon(rooms[i]->polygon, {.fill = kRoomTints[i % kRoomTints.size()]});
  }
  svg_.end_group();
}

void MapDrawing::draw_room_names() {
  svg_.begin_group("room-names");
  for (const core::Room& room : map_.plan().rooms) {
    svg_.text(centroid(room.polygon), room.name, {.fill = kLabel, .size = 17}, 0, 6);
  }
  svg_.end_group();
}

void MapDrawing::draw_grid(double step_m) {
  svg_.begin_group("grid");
  const Vec2 low = map_.lower_left();
  const Vec2 high = map_.upper_right();
  const Paint paint{.stroke = kGridInk, .stroke_width = 1};
  const double tolerance_m = step_m * 1e-6;
  for (double i = std::ceil(low.x() / step_m - 1e-6); i * step_m <= high.x() + tolerance_m; ++i) {
    const double x = i * step_m;
    svg_.line({x, low.y()}, {x, high.y()}, paint);
    svg_.text({x, low.y()}, short_number(x), {.fill = kLabel, .size = 12}, 0, 22);
  }
  for (double i = std::ceil(low.y() / step_m - 1e-6); i * step_m <= high.y() + tolerance_m; ++i) {
    const double y = i * step_m;
    svg_.line({low.x(), y}, {high.x(), y}, paint);
    svg_.text({low.x(), y}, short_number(y), {.fill = kLabel, .size = 12, .anchor = "end"}, -12, 4);
  }
  svg_.end_group();
}

void MapDrawing::draw_walls() {
  svg_.begin_group("walls");
  for (const core::Wall& wall : map_.plan().walls) {
    if (wall.thickness_m > 0) {
      svg_.polygon(solid_of(wall), {.fill = kInk});
    } else {
      svg_.line(wall.from, wall.to, {.stroke = kInk, .stroke_width = 2});
    }
  }
  svg_.end_group();
}

void MapDrawing::draw_corners() {
  svg_.begin_group("corners");
  for (const core::Corner& corner : map_.corners()) {
    svg_.dot(corner.position, 3.2, {.fill = corner.is_convex() ? kConvex : kConcave});
  }
  svg_.end_group();
}

void MapDrawing::draw_scale_bar(double length_m) {
  svg_.begin_group("scale");
  const double down_m = 44 / svg_.pixels_per_m();
  const double tick_m = 4 / svg_.pixels_per_m();
  const Vec2 from(map_.upper_right().x() - length_m, map_.lower_left().y() - down_m);
  const Vec2 to = from + Vec2(length_m, 0);
  const std::array<Vec2, 4> bar = {Vec2(from + Vec2(0, tick_m)), from, to,
                                   Vec2(to + Vec2(0, tick_m))};
  svg_.polyline(bar, {.stroke = kInk, .stroke_width = 1.5});
  svg_.text((from + to) / 2, short_number(length_m) + " m", {.fill = kInk, .size = 12}, 0, -6);
  svg_.end_group();
}

void MapDrawing::add_path(std::span<const Vec2> points, bool truth) {
  if (truth) {
    svg_.polyline(points, {.stroke = kInk, .stroke_width = 1, .opacity = 0.5, .dashes = "5 4"});
  } else {
    svg_.polyline(points, {.stroke = kRobot, .stroke_width = 1.6, .opacity = 0.75});
  }
}

void MapDrawing::add_track(std::span<const Vec2> points, std::string_view colour) {
  svg_.polyline(points, {.stroke = colour, .stroke_width = 1.6, .opacity = 0.85});
}

void MapDrawing::add_legend(std::string_view text, std::string_view colour) {
  constexpr double kLegendPx = 128;
  const double unit_m = 1 / svg_.pixels_per_m();
  const Vec2 from = map_.lower_left() + Vec2(kLegendPx * legends_++, -44) * unit_m;
  svg_.line(from, from + Vec2(16, 0) * unit_m, {.stroke = colour, .stroke_width = 2});
  svg_.text(from, text, {.fill = kInk, .size = 12, .anchor = "start"}, 20, 4);
}

void MapDrawing::add_scan(const core::Scan& scan, const core::Pose2& T_map_lidar) {
  svg_.begin_group("scan");
  for (const core::Sample& sample : scan.samples()) {
    if (sample.range_m <= 0) continue;
    const Vec2 point = core::unit_vector(sample.bearing_rad) * double{sample.range_m};
    svg_.dot(T_map_lidar * point, 1.7, {.fill = kReturn, .opacity = 0.8});
  }
  svg_.end_group();
}

void MapDrawing::add_points(std::span<const Vec2> points) {
  svg_.begin_group("points");
  for (const Vec2& point : points) svg_.dot(point, 0.8, {.fill = kReturn, .opacity = 0.35});
  svg_.end_group();
}

void MapDrawing::add_thin(const Vec2& from, const Vec2& to) {
  svg_.line(from, to, {.stroke = kConvex, .stroke_width = 4, .opacity = 0.8});
}

void MapDrawing::add_learned_wall(const core::Wall& wall, const core::WallOffset& offset) {
  constexpr double kMillimetres = 1000;
  svg_.line(wall.from, wall.to, {.stroke = kRobot, .stroke_width = 1.6});
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%+.0f ± %.0f", kMillimetres * offset.offset_m,
                kMillimetres * offset.sigma_m);
  svg_.text((wall.from + wall.to) / 2, text.data(), {.fill = kRobot, .size = 11}, 0, -5);
}

void MapDrawing::add_left_out(const Vec2& place) {
  const double arm_m = 4 * pixel_m();
  const Paint paint{.stroke = kBreakpoint, .stroke_width = 1.5};
  svg_.line(place + Vec2(-arm_m, -arm_m), place + Vec2(arm_m, arm_m), paint);
  svg_.line(place + Vec2(-arm_m, arm_m), place + Vec2(arm_m, -arm_m), paint);
}

void MapDrawing::add_closed(const Vec2& place, double width_m) {
  const double radius_px = std::max(4.0, width_m / 2 / pixel_m());
  svg_.dot(place, radius_px, {.stroke = kConvex, .stroke_width = 1.5});
}

void MapDrawing::add_examined_places(std::span<const ExaminedPlace> places) {
  svg_.begin_group("look-alikes");
  for (const ExaminedPlace& place : places) {
    for (const core::Pose2& other : place.look_alikes) {
      svg_.line(place.place.translation(), other.translation(),
                {.stroke = kRobot, .stroke_width = 0.6, .opacity = 0.25});
    }
  }
  for (const ExaminedPlace& place : places) {
    const std::string_view colour = place.is_known ? kReturn : place.is_lost ? kLabel : kRobot;
    svg_.dot(place.place.translation(), place.is_known ? 2 : 3.2, {.fill = colour});
  }
  svg_.end_group();
}

void MapDrawing::add_breakpoints(std::span<const core::Breakpoint> breakpoints,
                                 const core::Pose2& T_map_lidar) {
  svg_.begin_group("breakpoints");
  const double half_m = 5 / svg_.pixels_per_m();
  for (const core::Breakpoint& breakpoint : breakpoints) {
    const Vec2 at = T_map_lidar * breakpoint.position;
    const Paint paint{.stroke = kBreakpoint, .stroke_width = 1.6};
    if (breakpoint.kind == core::BreakpointKind::kCorner) {
      svg_.dot(at, 6.5, paint);
    } else {
      const std::array<Vec2, 4> square = {
          Vec2(at + Vec2(-half_m, -half_m)), Vec2(at + Vec2(half_m, -half_m)),
          Vec2(at + Vec2(half_m, half_m)), Vec2(at + Vec2(-half_m, half_m))};
      svg_.polygon(square, paint);
    }
  }
  svg_.end_group();
}

void MapDrawing::add_pose(const core::Pose2& T_map_base) {
  const double unit_m = 1 / svg_.pixels_per_m();
  const std::array<Vec2, 4> arrowhead = {
      T_map_base * Vec2(16 * unit_m, 0), T_map_base * Vec2(-9 * unit_m, 8 * unit_m),
      T_map_base * Vec2(-4 * unit_m, 0), T_map_base * Vec2(-9 * unit_m, -8 * unit_m)};
  svg_.polygon(arrowhead, {.fill = kRobot, .stroke = "#ffffff", .stroke_width = 1});
}

void MapDrawing::add_uncertainty(const core::Pose2& T_map_base,
                                 const core::Covariance3& covariance) {
  // 95 % of a normal distribution in the plane lies within sqrt(5.991) sigma (chi-square, 2 dof).
  constexpr double kSigmas95 = 2.4477;
  const Eigen::Matrix2d position = covariance.topLeftCorner<2, 2>();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(position);
  const Vec2 half = kSigmas95 * axes.eigenvalues().cwiseMax(0).cwiseSqrt();
  const Vec2 first = axes.eigenvectors().col(0);
  svg_.ellipse(T_map_base.translation(), half.x(), half.y(), std::atan2(first.y(), first.x()),
               {.fill = kRobot, .stroke = kRobot, .stroke_width = 1, .opacity = 0.35});
}

std::string MapDrawing::document(std::string_view subtitle) {
  const Vec2 upper_left(map_.lower_left().x(), map_.upper_right().y());
  svg_.text(upper_left, map_.plan().name,
            {.fill = kInk, .size = 20, .anchor = "start", .bold = true}, 0, -34);
  svg_.text(upper_left, subtitle, {.fill = kLabel, .size = 13, .anchor = "start"}, 0, -14);
  return svg_.document(map_.plan().name);
}

}  // namespace cornerd::tool
