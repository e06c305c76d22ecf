// SPDX-License-Identifier: MIT
#include "tool/drawing/scan_drawing.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "tool/drawing/metre_plot.hpp"
#include "tool/drawing/text_table.hpp"

namespace cornerd::tool {

namespace {

using Mark = LegendLine::Mark;

constexpr Paint kWall{.stroke = "#1f6f8b", .stroke_width = 2.5, .opacity = 0.8};
constexpr Paint kScanReturn{.fill = "#2f3640", .opacity = 0.7};
constexpr Paint kCornerRing{.stroke = "#c0392b", .stroke_width = 2};
constexpr Paint kEndSquare{.stroke = "#d68910", .stroke_width = 2};
constexpr Paint kLidarCross{.stroke = "#000000", .stroke_width = 1.5};
constexpr Paint kFarReturn{.fill = "#8e44ad"};

std::vector<core::Vec2> places_of(const core::Scan& scan) {
  std::vector<core::Vec2> places;
  for (const core::Sample& sample : scan.samples()) {
    if (sample.range_m <= 0) continue;
    const double bearing_rad = sample.bearing_rad;
    places.emplace_back(sample.range_m * std::cos(bearing_rad),
                        sample.range_m * std::sin(bearing_rad));
  }
  return places;
}

}  // namespace

std::string draw_scan(const core::Scan& scan, const core::Detection& detection) {
  const std::vector<core::Vec2> places = places_of(scan);
  Rectangle area = bounds_without_outliers(places);
  area.include({-0.5, -0.5});
  area.include({0.5, 0.5});
  const auto beyond = std::count_if(places.begin(), places.end(),
                                    [&](const auto& place) { return !area.contains(place); });
  const auto corners =
      std::count_if(detection.breakpoints.begin(), detection.breakpoints.end(),
                    [](const auto& point) { return point.kind == core::BreakpointKind::kCorner; });
  const auto ends = static_cast<std::ptrdiff_t>(detection.breakpoints.size()) - corners;
  std::vector<LegendLine> legend = {
      {"lidar, looking along x", kLidarCross, Mark::kCross},
      {formatted("returns: %zu of %zu samples", places.size(), scan.size()), kScanReturn,
       Mark::kDot},
      {formatted("walls: %zu", detection.segments.size()), kWall},
      {formatted("corners: %zd", corners), kCornerRing, Mark::kRing},
      {formatted("wall ends: %zd", ends), kEndSquare, Mark::kSquare}};
  if (beyond > 0) {
    legend.push_back(
        {formatted("returns beyond the frame, at its edge: %zd", beyond), kFarReturn, Mark::kDot});
  }
  MetrePlot plot(area, "One scan in the lidar's frame", legend);
  for (const core::Vec2& place : places) {
    const bool is_inside = area.contains(place);
    plot.mark(place.cwiseMax(area.low).cwiseMin(area.high), Mark::kDot, is_inside ? 1.3 : 2.5,
              is_inside ? kScanReturn : kFarReturn);
  }
  for (const core::WallSegment& wall : detection.segments) {
    if (area.contains(wall.first) && area.contains(wall.last)) {
      plot.line(wall.first, wall.last, kWall);
    }
  }
  for (const core::Breakpoint& point : detection.breakpoints) {
    if (!area.contains(point.position)) continue;
    const bool is_corner = point.kind == core::BreakpointKind::kCorner;
    plot.mark(point.position, is_corner ? Mark::kRing : Mark::kSquare, is_corner ? 6 : 5,
              is_corner ? kCornerRing : kEndSquare);
  }
  plot.mark(core::Vec2::Zero(), Mark::kCross, 10, kLidarCross);
  return plot.document();
}

}  // namespace cornerd::tool
