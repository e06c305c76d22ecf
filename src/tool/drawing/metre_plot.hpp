// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tool/drawing/svg.hpp"

namespace cornerd::tool {

/// 1, 2 or 5 times a power of ten: three to six steps over `size`.
double grid_step(double size);

/// A rectangle of the plane, metres.
struct Rectangle {
  core::Vec2 low;
  core::Vec2 high;

  bool contains(const core::Vec2& point) const {
    return (point.array() >= low.array()).all() && (point.array() <= high.array()).all();
  }
  void include(const core::Vec2& point) {
    low = low.cwiseMin(point);
    high = high.cwiseMax(point);
  }
};

/// Holds the points, but the few that lie far beyond all others. Empty: 1 m around the origin.
Rectangle bounds_without_outliers(std::span<const core::Vec2> points);

/// A line of the legend: what has this mark.
struct LegendLine {
  enum class Mark : std::uint8_t { kLine, kDot, kRing, kSquare, kCross };
  std::string text;
  Paint paint;
  Mark mark = Mark::kLine;
};

/// A drawing to scale: axes x and y in metres around it, title and legend above it.
class MetrePlot {
 public:
  MetrePlot(const Rectangle& area, std::string_view title, std::span<const LegendLine> legend);

  /// Points outside are left out: the line has a gap there.
  void polyline(std::span<const core::Vec2> points, const Paint& paint);
  /// `half_px`: half of the mark's size.
  void mark(const core::Vec2& at, LegendLine::Mark mark, double half_px, const Paint& paint);
  void line(const core::Vec2& from, const core::Vec2& to, const Paint& paint) {
    svg_.line(from, to, paint);
  }
  double pixels_per_m() const { return svg_.pixels_per_m(); }
  std::string document() const { return svg_.document(title_); }

 private:
  void draw_axes();

  Rectangle area_;
  std::string title_;
  Svg svg_;
};

}  // namespace cornerd::tool
