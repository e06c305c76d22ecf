// SPDX-License-Identifier: MIT
#include "tool/drawing/metre_plot.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "tool/drawing/text_table.hpp"

namespace cornerd::tool {

namespace {

using core::Vec2;
using Mark = LegendLine::Mark;

constexpr double kMetreMarginPx = 60;
constexpr double kMetreSidePx = 900;
/// Room for title and legend beside a narrow drawing.
constexpr double kMinWidthPx = 420;
constexpr double kMetreTitlePx = 32;
constexpr double kMetreLinePx = 18;

/// A value beyond this quantile, on either side, is an outlier if it also is farther away than this
/// share of the others' range.
constexpr double kOutlierQuantile = 0.01;
constexpr double kFarShare = 0.25;
constexpr double kMarginShare = 0.05;

double scale_of(const Rectangle& area) { return kMetreSidePx / (area.high - area.low).maxCoeff(); }

/// The area, with the legend's lines above it.
Rectangle page_of(const Rectangle& area, std::size_t legend_lines) {
  const double scale = scale_of(area);
  const double legend_px = kMetreTitlePx + kMetreLinePx * static_cast<double>(legend_lines);
  Rectangle page = area;
  page.high.y() += legend_px / scale;
  page.high.x() = std::max(page.high.x(), page.low.x() + kMinWidthPx / scale);
  return page;
}

/// Lowest and highest of the values that are no outliers.
std::pair<double, double> limits(std::vector<double>& values) {
  std::sort(values.begin(), values.end());
  const auto outliers =
      static_cast<std::size_t>(std::lround(kOutlierQuantile * static_cast<double>(values.size())));
  const double low = values[outliers];
  const double high = values[values.size() - 1 - outliers];
  const double range = high - low;
  const auto limit = [&](double extreme, double quantile, double outwards) {
    return std::abs(extreme - quantile) <= kFarShare * range
               ? extreme
               : quantile + outwards * kMarginShare * range;
  };
  return {limit(values.front(), low, -1), limit(values.back(), high, 1)};
}

}  // namespace

double grid_step(double size) {
  const double rough = size / 5;
  const double power = std::pow(10, std::floor(std::log10(rough)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * power >= rough) return factor * power;
  }
  return 10 * power;
}

Rectangle bounds_without_outliers(std::span<const Vec2> points) {
  if (points.empty()) return {Vec2(-1, -1), Vec2(1, 1)};
  std::vector<double> xs;
  std::vector<double> ys;
  for (const Vec2& point : points) {
    xs.push_back(point.x());
    ys.push_back(point.y());
  }
  const auto [left, right] = limits(xs);
  const auto [bottom, top] = limits(ys);
  return {Vec2(left, bottom), Vec2(right, top)};
}

MetrePlot::MetrePlot(const Rectangle& area, std::string_view title,
                     std::span<const LegendLine> legend)
    : area_(area),
      title_(title),
      svg_(page_of(area, legend.size()).low, page_of(area, legend.size()).high, scale_of(area),
           kMetreMarginPx) {
  draw_axes();
  const double px = 1 / svg_.pixels_per_m();
  Vec2 at(area_.low.x(),
          area_.high.y() + (kMetreLinePx * static_cast<double>(legend.size()) + 16) * px);
  svg_.text(at, title_, {.fill = kInk, .size = 15, .anchor = "start", .bold = true});
  for (const LegendLine& line : legend) {
    at.y() -= kMetreLinePx * px;
    if (line.mark == Mark::kLine) {
      svg_.line(at, at + Vec2(28 * px, 0), line.paint);
    } else {
      mark(at + Vec2(14 * px, 0), line.mark, 5, line.paint);
    }
    svg_.text(at, line.text, {.fill = kInk, .anchor = "start"}, 36, 4);
  }
}

void MetrePlot::draw_axes() {
  const Paint grid{.stroke = kGridInk};
  const TextStyle tick{.fill = kInk, .size = 11};
  const auto& [low, high] = area_;
  const double step_m = grid_step((high - low).maxCoeff());
  const auto value = [](double v) { return formatted("%g", std::abs(v) < 1e-9 ? 0 : v); };
  for (double x = std::ceil(low.x() / step_m) * step_m; x <= high.x(); x += step_m) {
    svg_.line({x, low.y()}, {x, high.y()}, grid);
    svg_.text({x, low.y()}, value(x), tick, 0, 18);
  }
  for (double y = std::ceil(low.y() / step_m) * step_m; y <= high.y(); y += step_m) {
    svg_.line({low.x(), y}, {high.x(), y}, grid);
    svg_.text({low.x(), y}, value(y), {.fill = kInk, .size = 11, .anchor = "end"}, -6, 4);
  }
  const std::array frame = {low, Vec2(high.x(), low.y()), high, Vec2(low.x(), high.y())};
  svg_.polygon(frame, {.stroke = kInk, .stroke_width = 0.6});
  const Vec2 middle = (low + high) / 2;
  svg_.text({middle.x(), low.y()}, "x [m]", {.fill = kInk, .size = 13}, 0, 42);
  svg_.text({low.x(), middle.y()}, "y [m]", {.fill = kInk, .size = 13, .rotation_deg = 90}, -42, 0);
}

void MetrePlot::polyline(std::span<const Vec2> points, const Paint& paint) {
  while (!points.empty()) {
    const auto inside = [this](const Vec2& point) { return area_.contains(point); };
    const auto begin = std::find_if(points.begin(), points.end(), inside);
    const auto end = std::find_if_not(begin, points.end(), inside);
    if (end - begin > 1) svg_.polyline({begin, end}, paint);
    points = {end, points.end()};
  }
}

void MetrePlot::mark(const Vec2& at, Mark mark, double half_px, const Paint& paint) {
  const double half_m = half_px / svg_.pixels_per_m();
  switch (mark) {
    case Mark::kDot:
      return svg_.dot(at, std::min(half_px, 2.5), paint);
    case Mark::kRing:
      return svg_.dot(at, half_px, paint);
    case Mark::kSquare: {
      const std::array square = {Vec2(at + half_m * Vec2(-1, -1)), Vec2(at + half_m * Vec2(1, -1)),
                                 Vec2(at + half_m * Vec2(1, 1)), Vec2(at + half_m * Vec2(-1, 1))};
      return svg_.polygon(square, paint);
    }
    case Mark::kCross:
      svg_.line(at - Vec2(half_m, 0), at + Vec2(half_m, 0), paint);
      return svg_.line(at - Vec2(0, half_m), at + Vec2(0, half_m), paint);
    case Mark::kLine:
      return svg_.line(at - Vec2(half_m, 0), at + Vec2(half_m, 0), paint);
  }
}

}  // namespace cornerd::tool
