// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tool/drawing/svg.hpp"

namespace cornerd::tool {

/// One axis of a plot, from `low` to `high`.
struct PlotAxis {
  double low = 0;
  double high = 1;
  std::string_view label = {};
};

/// An x-y plot with a grid. Dots outside the axes are moved to their edge; points of lines outside
/// the y axis are left out.
class Plot {
 public:
  Plot(const PlotAxis& x, const PlotAxis& y, std::string_view title);

  void dot(double x, double y, double radius_px, const Paint& paint);
  /// Points with a y outside the axis interrupt the line.
  void line(std::span<const core::Vec2> points, const Paint& paint);
  /// A line of the legend, in the paint of its dots or line.
  void legend(std::string_view text, const Paint& paint);

  std::string document() const { return svg_.document(title_); }

 private:
  core::Vec2 position(double x, double y) const;
  void draw_axes();

  PlotAxis x_;
  PlotAxis y_;
  std::string title_;
  Svg svg_;
  int legends_ = 0;
};

}  // namespace cornerd::tool
