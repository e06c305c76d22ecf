// SPDX-License-Identifier: MIT
#include "tool/drawing/noise_drawing.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string_view>
#include <utility>
#include <vector>

#include "tool/drawing/plot.hpp"

namespace cornerd::tool {

namespace {

using calibration::BinSpread;
using calibration::RangeCell;

constexpr Paint kDirection{.fill = "#1b9e77", .opacity = 0.35};
constexpr Paint kCellBar{.stroke = kInk, .stroke_width = 1.5};
constexpr Paint kCellDot{.fill = kInk};
constexpr Paint kPlainLine{.stroke = "#c2255c", .stroke_width = 2};
constexpr Paint kTableLine{.stroke = "#2f6f9f", .stroke_width = 2, .dashes = "6 4"};
constexpr double kToMm = 1e3;
constexpr std::array<std::string_view, 6> kWallTints = {"#c2255c", "#2f6f9f", "#1b9e77",
                                                        "#d1813a", "#6741d9", kInk};

std::vector<core::Vec2> curve(const core::SensorNoise& noise, double end_m) {
  std::vector<core::Vec2> points;
  constexpr int kSteps = 400;
  for (int i = 0; i <= kSteps; ++i) {
    const double range_m = end_m * i / kSteps;
    points.emplace_back(range_m, kToMm * noise.sigma_range_m(range_m));
  }
  return points;
}

}  // namespace

std::string draw_noise(const calibration::RangeNoise& noise, std::span<const BinSpread> bins) {
  const double end_m = std::ceil(2 * noise.cells.back().to_m) / 2;
  double highest_m = 0;
  for (const RangeCell& cell : noise.cells) highest_m = std::max(highest_m, cell.high_m);
  Plot plot({0, end_m, "range (m)"}, {0, 1.6 * kToMm * highest_m, "sigma of the range (mm)"},
            "Noise of the lidar");
  for (const BinSpread& bin : bins) {
    if (bin.range_m < end_m) plot.dot(bin.range_m, kToMm * bin.sigma_m, 2, kDirection);
  }
  for (const RangeCell& cell : noise.cells) {
    const core::Vec2 bar[] = {{cell.range_m, kToMm * cell.low_m},
                              {cell.range_m, kToMm * cell.high_m}};
    plot.line(bar, kCellBar);
    plot.dot(cell.range_m, kToMm * cell.sigma_m, 4, kCellDot);
  }
  plot.line(curve(noise.plain, end_m), kPlainLine);
  core::SensorNoise tabled = noise.plain;
  tabled.table = core::SigmaTable(noise.table());
  plot.line(curve(tabled, end_m), kTableLine);
  plot.legend("one direction, measured", kDirection);
  plot.legend("range only: median and quartiles", kCellDot);
  plot.legend("floor and share", kPlainLine);
  plot.legend("table", kTableLine);
  return plot.document();
}

std::string draw_walls(std::span<const calibration::WallPieceFit> fits,
                       std::span<const calibration::KnownWall> walls) {
  std::vector<calibration::WallPiece> pieces;
  double rays_deg = 10;
  double highest_mm = 1;
  for (const calibration::WallPieceFit& fit : fits) {
    pieces.push_back(fit.piece);
    rays_deg = std::max(rays_deg, core::degrees(fit.piece.ray_rad));
    highest_mm = std::max(highest_mm, kToMm * (fit.rms_m + 2 * fit.piece.sigma_m));
  }
  const calibration::WallModel model(std::move(pieces));
  Plot plot({-rays_deg, rays_deg, "ray, from the wall's normal (degrees)"},
            {-highest_mm, highest_mm, "range error (mm)"}, "Walls at known distances");
  constexpr std::size_t kMaxDots = 300;  // for each wall
  for (std::size_t i = 0; i < walls.size(); ++i) {
    const auto& returns = walls[i].returns;
    const Paint dots{.fill = kWallTints[i % kWallTints.size()], .opacity = 0.3};
    for (std::size_t k = 0; k < returns.size(); k += 1 + returns.size() / kMaxDots) {
      plot.dot(core::degrees(returns[k].ray_rad), kToMm * returns[k].error_m, 1.5, dots);
    }
  }
  for (std::size_t i = 0; i < walls.size(); ++i) {
    const Paint stroke{.stroke = kWallTints[i % kWallTints.size()], .stroke_width = 1.5};
    std::vector<core::Vec2> points;
    for (double ray_deg = -rays_deg; ray_deg <= rays_deg; ray_deg += 1) {
      const double error_m = model.error_m(walls[i].distance_m, core::radians(ray_deg));
      points.emplace_back(ray_deg, kToMm * error_m);
    }
    plot.line(points, stroke);
    char label[32];
    std::snprintf(label, sizeof label, "%.2f m", walls[i].distance_m);
    constexpr std::size_t kMaxLegends = 16;
    if (i < kMaxLegends) plot.legend(label, stroke);
  }
  return plot.document();
}

}  // namespace cornerd::tool
