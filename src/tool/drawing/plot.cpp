// SPDX-License-Identifier: MIT
#include "tool/drawing/plot.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "tool/drawing/metre_plot.hpp"

namespace cornerd::tool {

namespace {

core::Vec2 size_of_plot() { return {8, 5}; }
constexpr double kPixelsPerUnit = 100;
constexpr double kPlotMarginPx = 60;
constexpr double kLegendLinePx = 18;

std::string tick_text(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.10g", std::abs(value) < 1e-12 ? 0.0 : value);
  return text;
}

}  // namespace

Plot::Plot(const PlotAxis& x, const PlotAxis& y, std::string_view title)
    : x_(x), y_(y), title_(title), svg_({0, 0}, size_of_plot(), kPixelsPerUnit, kPlotMarginPx) {
  draw_axes();
}

core::Vec2 Plot::position(double x, double y) const {
  const core::Vec2 share((x - x_.low) / (x_.high - x_.low), (y - y_.low) / (y_.high - y_.low));
  return share.cwiseMax(0).cwiseMin(1).cwiseProduct(size_of_plot());
}

void Plot::draw_axes() {
  const Paint grid{.stroke = kGridInk};
  const TextStyle tick{.fill = kInk, .size = 11};
  svg_.begin_group("axes");
  const double dx = grid_step(x_.high - x_.low);
  for (double x = std::ceil(x_.low / dx) * dx; x <= x_.high + dx * 1e-6; x += dx) {
    svg_.line(position(x, y_.low), position(x, y_.high), grid);
    svg_.text(position(x, y_.low), tick_text(x), tick, 0, 18);
  }
  const double dy = grid_step(y_.high - y_.low);
  for (double y = std::ceil(y_.low / dy) * dy; y <= y_.high + dy * 1e-6; y += dy) {
    svg_.line(position(x_.low, y), position(x_.high, y), grid);
    svg_.text(position(x_.low, y), tick_text(y), {.fill = kInk, .size = 11, .anchor = "end"}, -6,
              4);
  }
  const TextStyle label{.fill = kInk, .size = 13};
  svg_.text(position((x_.low + x_.high) / 2, y_.low), x_.label, label, 0, 42);
  svg_.text(position(x_.low, (y_.low + y_.high) / 2), y_.label,
            {.fill = kInk, .size = 13, .rotation_deg = 90}, -40, 0);
  svg_.text(position((x_.low + x_.high) / 2, y_.high), title_,
            {.fill = kInk, .size = 15, .bold = true}, 0, -24);
  svg_.end_group();
}

void Plot::dot(double x, double y, double radius_px, const Paint& paint) {
  svg_.dot(position(x, y), radius_px, paint);
}

void Plot::line(std::span<const core::Vec2> points, const Paint& paint) {
  std::vector<core::Vec2> piece;
  const auto draw = [&] {
    if (piece.size() > 1) svg_.polyline(piece, paint);
    piece.clear();
  };
  for (const core::Vec2& point : points) {
    if (point.y() >= y_.low && point.y() <= y_.high) {
      piece.push_back(position(point.x(), point.y()));
    } else {
      draw();
    }
  }
  draw();
}

void Plot::legend(std::string_view text, const Paint& paint) {
  const double down_px = 14 + kLegendLinePx * legends_++;
  const core::Vec2 at(0.15, size_of_plot().y() - down_px / kPixelsPerUnit);
  if (paint.stroke == "none") {
    svg_.dot(at + core::Vec2(0.15, 0), 3, paint);
  } else {
    svg_.line(at, at + core::Vec2(0.3, 0), paint);
  }
  svg_.text(at + core::Vec2(0.4, 0), text, {.fill = kInk, .size = 12, .anchor = "start"}, 0, 4);
}

}  // namespace cornerd::tool
