// SPDX-License-Identifier: MIT
#include "tool/drawing/drive_drawing.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "tool/drawing/svg.hpp"
#include "tool/drawing/text_table.hpp"

namespace cornerd::tool {

namespace {

using core::Vec2;

constexpr double kDriveMarginPx = 50;
constexpr double kLongerSidePx = 900;
constexpr double kDriveLegendLinePx = 18;
constexpr std::string_view kWallInk = "#2f3640";
constexpr std::string_view kDriveGridInk = "#e9e6df";

struct Bounds {
  Vec2 low{1e9, 1e9};
  Vec2 high{-1e9, -1e9};
  void take(const Vec2& point) {
    low = low.cwiseMin(point);
    high = high.cwiseMax(point);
  }
};

Bounds bounds_of(std::span<const DrawnTrack> tracks, const core::WallMap* map) {
  Bounds bounds;
  for (const DrawnTrack& track : tracks) {
    for (const Vec2& point : track.points) bounds.take(point);
  }
  if (map != nullptr) {
    bounds.take(map->lower_left());
    bounds.take(map->upper_right());
  }
  if (!(bounds.low.x() <= bounds.high.x())) bounds = {Vec2::Zero(), Vec2::Ones()};
  // A robot at rest needs a rectangle of some size, too.
  bounds.high = bounds.high.cwiseMax(bounds.low + Vec2::Ones());
  return bounds;
}

/// Drops points nearer than `min_step_m` to the last kept one, except the end.
std::vector<Vec2> thinned(std::span<const Vec2> points, double min_step_m) {
  std::vector<Vec2> thin;
  for (const Vec2& point : points) {
    if (thin.empty() || (point - thin.back()).norm() >= min_step_m) thin.push_back(point);
  }
  if (!points.empty()) thin.push_back(points.back());
  return thin;
}

/// 1, 2 or 5 times a power of ten: about five steps.
double grid_step(double size_m) {
  const double power = std::pow(10, std::floor(std::log10(size_m / 5)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * power >= size_m / 5) return factor * power;
  }
  return 10 * power;
}

void draw_metres(Svg& svg, const Bounds& bounds, double step_m) {
  const Paint grid{.stroke = kDriveGridInk};
  const TextStyle label{.fill = kWallInk, .size = 11};
  for (double x = std::ceil(bounds.low.x() / step_m) * step_m; x <= bounds.high.x(); x += step_m) {
    svg.line({x, bounds.low.y()}, {x, bounds.high.y()}, grid);
    svg.text({x, bounds.low.y()}, formatted("%g", x), label, 0, 18);
  }
  for (double y = std::ceil(bounds.low.y() / step_m) * step_m; y <= bounds.high.y(); y += step_m) {
    svg.line({bounds.low.x(), y}, {bounds.high.x(), y}, grid);
    svg.text({bounds.low.x(), y}, formatted("%g", y),
             {.fill = kWallInk, .size = 11, .anchor = "end"}, -6, 4);
  }
}

}  // namespace

std::string draw_drive(std::string_view title, std::span<const DrawnTrack> tracks,
                       const core::WallMap* map) {
  const Bounds bounds = bounds_of(tracks, map);
  const double size_m = (bounds.high - bounds.low).maxCoeff();
  Svg svg(bounds.low, bounds.high, kLongerSidePx / size_m, kDriveMarginPx);
  draw_metres(svg, bounds, grid_step(size_m));
  if (map != nullptr) {
    for (const core::Wall& wall : map->plan().walls) {
      svg.line(wall.from, wall.to, {.stroke = kWallInk, .stroke_width = 1.5});
    }
  }
  const Vec2 upper_left(bounds.low.x(), bounds.high.y());
  double down_px = 14;
  for (const DrawnTrack& track : tracks) {
    const Paint paint{.stroke = track.colour,
                      .stroke_width = track.is_truth ? 1.0 : 1.6,
                      .opacity = 0.85,
                      .dashes = track.is_truth ? "5 4" : ""};
    svg.polyline(thinned(track.points, 1.5 / svg.pixels_per_m()), paint);
    svg.text(upper_left, track.name,
             {.fill = track.colour, .size = 13, .anchor = "start", .bold = true}, 8, down_px);
    down_px += kDriveLegendLinePx;
  }
  svg.text(upper_left, title, {.fill = kWallInk, .size = 15, .anchor = "start", .bold = true}, 0,
           -16);
  return svg.document(title);
}

}  // namespace cornerd::tool
