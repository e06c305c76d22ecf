// SPDX-License-Identifier: MIT
#include "tool/drawing/scan_drawing.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "tool/drawing/svg.hpp"

namespace cornerd::tool {

namespace {

constexpr double kWidthPx = 860;
constexpr double kScanMarginPx = 40;
constexpr Paint kWall{.stroke = "#1f6f8b", .stroke_width = 2.5, .opacity = 0.8};
constexpr Paint kScanReturn{.fill = "#2f3640", .opacity = 0.7};
constexpr Paint kCornerRing{.stroke = "#c0392b", .stroke_width = 2};
constexpr Paint kEndSquare{.stroke = "#d68910", .stroke_width = 2};
constexpr Paint kLidarCross{.stroke = "#000000", .stroke_width = 1.5};
constexpr Paint kGridLine{.stroke = "#dcdde1", .stroke_width = 0.8};

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

void draw_metres(Svg& svg, const core::Vec2& low, const core::Vec2& high) {
  for (double x = std::ceil(low.x()); x <= high.x(); ++x) {
    svg.line({x, low.y()}, {x, high.y()}, kGridLine);
  }
  for (double y = std::ceil(low.y()); y <= high.y(); ++y) {
    svg.line({low.x(), y}, {high.x(), y}, kGridLine);
  }
}

}  // namespace

std::string draw_scan(const core::Scan& scan, const core::Detection& detection,
                      const std::string& subtitle) {
  const std::vector<core::Vec2> places = places_of(scan);
  core::Vec2 low(-0.5, -0.5);
  core::Vec2 high(0.5, 0.5);
  for (const core::Vec2& place : places) {
    low = low.cwiseMin(place);
    high = high.cwiseMax(place);
  }
  Svg svg(low, high, kWidthPx / (high - low).x(), kScanMarginPx);
  draw_metres(svg, low, high);
  for (const core::Vec2& place : places) svg.dot(place, 1.3, kScanReturn);
  for (const core::WallSegment& wall : detection.segments) svg.line(wall.first, wall.last, kWall);
  const double half_m = 5 / svg.pixels_per_m();
  for (const core::Breakpoint& breakpoint : detection.breakpoints) {
    const core::Vec2& at = breakpoint.position;
    if (breakpoint.kind == core::BreakpointKind::kCorner) {
      svg.dot(at, 6, kCornerRing);
    } else {
      const std::array square = {
          core::Vec2(at + half_m * core::Vec2(-1, -1)), core::Vec2(at + half_m * core::Vec2(1, -1)),
          core::Vec2(at + half_m * core::Vec2(1, 1)), core::Vec2(at + half_m * core::Vec2(-1, 1))};
      svg.polygon(square, kEndSquare);
    }
  }
  svg.line({-2 * half_m, 0}, {2 * half_m, 0}, kLidarCross);
  svg.line({0, -2 * half_m}, {0, 2 * half_m}, kLidarCross);
  svg.text({low.x(), high.y()}, subtitle + "; grid: 1 m", {.size = 13, .anchor = "start"}, 0, -14);
  return svg.document("one scan");
}

}  // namespace cornerd::tool
