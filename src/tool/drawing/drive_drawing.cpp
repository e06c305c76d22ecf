// SPDX-License-Identifier: MIT
#include "tool/drawing/drive_drawing.hpp"

#include <algorithm>
#include <vector>

#include "tool/drawing/metre_plot.hpp"
#include "tool/drawing/svg.hpp"
#include "tool/drawing/text_table.hpp"

namespace cornerd::tool {

namespace {

using core::Vec2;

Rectangle area_of(std::span<const DrawnTrack> tracks, const core::WallMap* map) {
  std::vector<Vec2> points;
  for (const DrawnTrack& track : tracks) {
    points.insert(points.end(), track.points.begin(), track.points.end());
  }
  Rectangle area = bounds_without_outliers(points);
  if (map != nullptr) {
    area.include(map->lower_left());
    area.include(map->upper_right());
  }
  // A robot at rest needs a rectangle of some size, too.
  area.include(area.low + Vec2::Ones());
  return area;
}

Paint paint_of(const DrawnTrack& track) {
  return {.stroke = track.colour,
          .stroke_width = track.is_truth ? 1.0 : 1.6,
          .opacity = 0.85,
          .dashes = track.is_truth ? "5 4" : ""};
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

}  // namespace

std::string draw_drive(std::string_view title, std::span<const DrawnTrack> tracks,
                       const core::WallMap* map) {
  const Rectangle area = area_of(tracks, map);
  std::vector<LegendLine> legend;
  for (const DrawnTrack& track : tracks) {
    const auto outside = std::count_if(track.points.begin(), track.points.end(),
                                       [&](const Vec2& point) { return !area.contains(point); });
    legend.push_back({track.name + (outside == 0 ? "" : formatted("; %zd points outside", outside)),
                      paint_of(track)});
  }
  const Paint wall_paint{.stroke = kInk, .stroke_width = 1.5};
  if (map != nullptr) legend.push_back({"walls of the map", wall_paint});
  MetrePlot plot(area, title, legend);
  if (map != nullptr) {
    for (const core::Wall& wall : map->plan().walls) {
      plot.line(wall.from, wall.to, wall_paint);
    }
  }
  for (const DrawnTrack& track : tracks) {
    plot.polyline(thinned(track.points, 1.5 / plot.pixels_per_m()), paint_of(track));
  }
  return plot.document();
}

}  // namespace cornerd::tool
