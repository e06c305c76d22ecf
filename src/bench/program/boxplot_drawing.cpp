// SPDX-License-Identifier: MIT
#include "bench/program/boxplot_drawing.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "bench/statistics.hpp"
#include "tool/drawing/svg.hpp"

namespace cornerd::bench {

namespace {

using core::Vec2;

// Drawn in pixels: one metre of Svg is one pixel.
constexpr double kSlotPx = 150;
constexpr double kHeightPx = 340;
constexpr double kMarginAroundPx = 76;
constexpr double kHalfBoxPx = 32;
constexpr double kHalfCapPx = 14;

constexpr std::string_view kBoxLabel = "#8c867a";
constexpr std::string_view kMedian = "#c2255c";
constexpr std::array<std::string_view, 4> kBoxTints = {"#9cc9e3", "#f0c490", "#b8d8b0", "#d9bfe3"};

/// A step of 1, 2 or 5 times a power of ten that divides the axis into 4 to 10 parts.
double boxplot_step(double highest) {
  const double power = std::pow(10, std::floor(std::log10(highest)));
  for (const double factor : {2.0, 1.0, 0.5, 0.2}) {
    if (highest / (factor * power) >= 4) return factor * power;
  }
  return power / 10;
}

std::string boxplot_tick(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%g", value);
  return text.data();
}

class BoxplotPage {
 public:
  BoxplotPage(std::span<const BoxplotSeries> series, double highest)
      : width_px_(kSlotPx * static_cast<double>(std::max<std::size_t>(series.size(), 1))),
        scale_(kHeightPx / highest),
        svg_({0, 0}, {width_px_, kHeightPx}, 1, kMarginAroundPx) {}

  void axis(double highest, const std::string& name) {
    const double step = boxplot_step(highest);
    for (double i = 0; i * step <= highest * (1 + 1e-9); ++i) {
      const double y = i * step * scale_;
      svg_.line({0, y}, {width_px_, y}, {.stroke = tool::kGridInk});
      svg_.text({0, y}, boxplot_tick(i * step), {.fill = kBoxLabel, .anchor = "end"}, -10, 4);
    }
    svg_.text({0, kHeightPx / 2}, name, {.fill = tool::kInk, .size = 13, .rotation_deg = 90}, -52);
  }

  void box(std::size_t slot, const BoxplotSeries& series) {
    const double x = kSlotPx * (static_cast<double>(slot) + 0.5);
    svg_.text({x, 0}, series.name, {.fill = tool::kInk, .size = 14}, 0, 26);
    if (series.values.empty()) return;
    const BoxplotStatistics plot = boxplot_of(series.values);
    const tool::Paint ink{.stroke = tool::kInk, .stroke_width = 1.4};
    whisker(x, plot.upper_quartile, plot.upper_whisker, ink);
    whisker(x, plot.lower_quartile, plot.lower_whisker, ink);
    const double low = plot.lower_quartile * scale_;
    const double high = plot.upper_quartile * scale_;
    const std::array<Vec2, 4> outline = {Vec2(x - kHalfBoxPx, low), Vec2(x + kHalfBoxPx, low),
                                         Vec2(x + kHalfBoxPx, high), Vec2(x - kHalfBoxPx, high)};
    svg_.polygon(
        outline,
        {.fill = kBoxTints[slot % kBoxTints.size()], .stroke = tool::kInk, .stroke_width = 1.4});
    const double median = plot.median * scale_;
    svg_.line({x - kHalfBoxPx, median}, {x + kHalfBoxPx, median},
              {.stroke = kMedian, .stroke_width = 2.4});
    for (const double value : plot.outliers) svg_.dot({x, value * scale_}, 3, ink);
  }

  std::string document(const BoxplotTexts& texts) {
    svg_.text({0, kHeightPx}, texts.title,
              {.fill = tool::kInk, .size = 16, .anchor = "start", .bold = true}, 0, -40);
    svg_.text({0, kHeightPx}, texts.subtitle, {.fill = kBoxLabel, .anchor = "start"}, 0, -20);
    return svg_.document(texts.title);
  }

 private:
  void whisker(double x, double from, double to, const tool::Paint& paint) {
    svg_.line({x, from * scale_}, {x, to * scale_}, paint);
    svg_.line({x - kHalfCapPx, to * scale_}, {x + kHalfCapPx, to * scale_}, paint);
  }

  double width_px_;
  double scale_;
  tool::Svg svg_;
};

}  // namespace

std::string draw_boxplots(const BoxplotTexts& texts, std::span<const BoxplotSeries> series) {
  double highest = 0;
  for (const BoxplotSeries& one : series) {
    for (const double value : one.values) highest = std::max(highest, value);
  }
  if (highest <= 0) highest = 1;
  constexpr double kHeadroom = 1.05;
  BoxplotPage page(series, highest * kHeadroom);
  page.axis(highest * kHeadroom, texts.axis);
  for (std::size_t i = 0; i < series.size(); ++i) page.box(i, series[i]);
  return page.document(texts);
}

}  // namespace cornerd::bench
