// SPDX-License-Identifier: MIT
#include "tool/calibrate/noise_report.hpp"

#include <algorithm>
#include <cmath>
#include <cstdarg>
#include <cstdio>

#include "core/geometry/angle.hpp"

namespace cornerd::tool {

namespace {

using calibration::RangeCell;
using calibration::RangeNoise;

constexpr double kMmPerM = 1e3;

__attribute__((format(printf, 2, 3))) void append_line(std::string& out, const char* format, ...) {
  char line[200];
  va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(line, sizeof line, format, arguments);
  va_end(arguments);
  out += line;
  out += '\n';
}

/// Three significant digits without an exponent.
std::string short_decimal(double value) {
  const int digits = 2 - static_cast<int>(std::floor(std::log10(std::max(value, 1e-9))));
  char text[32];
  std::snprintf(text, sizeof text, "%.*f", std::clamp(digits, 0, 9), value);
  return text;
}

void append_cells(std::string& out, const RangeNoise& noise) {
  append_line(out, "%-13s %10s %10s %14s %10s %9s  %s", "range [m]", "directions", "sigma [mm]",
              "quartiles [mm]", "model [mm]", "residual", "with oblique [mm]");
  double end_m = 0;
  for (const RangeCell& cell : noise.cells) {
    if (end_m > 0 && cell.from_m > end_m) {
      append_line(out, "%.2f - %-6.2f %10s", end_m, cell.from_m, "too few");
    }
    end_m = cell.to_m;
    const double model_m = noise.plain.sigma_range_m(cell.range_m);
    char quartiles[32];
    std::snprintf(quartiles, sizeof quartiles, "%.2f - %.2f", kMmPerM * cell.low_m,
                  kMmPerM * cell.high_m);
    append_line(out, "%.2f - %-6.2f %10zu %10.2f %14s %10.2f %+8.0f%% %16.2f", cell.from_m,
                cell.to_m, cell.bins, kMmPerM * cell.sigma_m, quartiles, kMmPerM * model_m,
                100 * (cell.sigma_m / model_m - 1), kMmPerM * cell.sigma_all_m);
  }
}

/// Nine digits: the polynomial's terms cancel.
std::string exact_number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.9g", value);
  return text;
}

void append_wall_model(std::string& out, std::span<const calibration::WallPieceFit> walls) {
  out += ",\n      \"wall\": [";
  std::string separator = "\n";
  for (const calibration::WallPieceFit& fit : walls) {
    const calibration::WallPiece& piece = fit.piece;
    out += separator + "        { \"from\": " + exact_number(piece.from_m) +
           ", \"to\": " + exact_number(piece.to_m) + ", \"ray\": " + exact_number(piece.ray_rad) +
           ", \"sigma\": " + short_decimal(piece.sigma_m) + ",\n          \"coefficients\": [";
    for (std::size_t i = 0; i <= fit.ray_order; ++i) {
      out += i == 0 ? " [" : ",\n                            [";
      for (std::size_t j = 0; j <= fit.distance_order; ++j) {
        out += (j == 0 ? " " : ", ") + exact_number(piece.coefficients[i][j]);
      }
      out += " ]";
    }
    out += " ] }";
    separator = ",\n";
  }
  out += "\n      ]";
}

}  // namespace

std::string describe_noise(const RangeNoise& noise) {
  std::string out;
  append_cells(out, noise);
  out += '\n';
  append_line(out,
              "model    sigma = max(%.2f mm, %.2f %% of the range); residual %.0f %% in the mean",
              kMmPerM * noise.plain.floor_m, 100 * noise.plain.share,
              100 * std::expm1(noise.plain_residual));
  if (noise.bearing_measured) {
    append_line(out, "bearing  %.3f degrees, from oblique walls",
                core::degrees(noise.plain.bearing_rad));
  } else {
    append_line(out, "bearing  not measured (too few oblique walls); %.3f degrees by default",
                core::degrees(noise.plain.bearing_rad));
  }
  append_line(out, "No data below %.2f m, where the nearest sigma holds, and beyond",
              noise.cells.front().range_m);
  append_line(out, "%.2f m, where sigma grows with the range; gaps are interpolated linearly.",
              noise.cells.back().range_m);
  return out;
}

std::string describe_distances(std::span<const calibration::KnownWall> walls) {
  std::string out;
  append_line(out, "%-12s %12s %10s %8s", "wall at [m]", "measured [m]", "bias [mm]", "returns");
  double x = 0;
  double y = 0;
  double xx = 0;
  double xy = 0;
  const auto n = static_cast<double>(walls.size());
  for (const calibration::KnownWall& wall : walls) {
    append_line(out, "%-12.3f %12.4f %+10.2f %8zu", wall.distance_m, wall.measured_m,
                kMmPerM * (wall.measured_m - wall.distance_m), wall.returns.size());
    x += wall.distance_m / n;
    y += wall.measured_m / n;
    xx += wall.distance_m * wall.distance_m / n;
    xy += wall.distance_m * wall.measured_m / n;
  }
  const double variance = xx - x * x;
  constexpr double kMinVariance_m2 = 0.01;  // distances 10 cm about their mean
  if (variance > kMinVariance_m2) {
    const double scale = (xy - x * y) / variance;
    append_line(out, "bias     measured = %.4f * true %+.2f mm", scale, kMmPerM * (y - scale * x));
  }
  return out;
}

std::string describe_wall_model(std::span<const calibration::WallPieceFit> fits,
                                bool distances_known) {
  std::string out;
  append_line(out, "%-13s %9s %8s %10s %10s %10s %13s  %s", "wall [m]", "distances", "returns",
              "ray order", "its order", "error [mm]", "residual [mm]", "beyond 3 sigma");
  for (const calibration::WallPieceFit& fit : fits) {
    append_line(out, "%.2f - %-6.2f %9zu %8zu %10zu %10zu %10.2f %13.2f %14.2f%%", fit.piece.from_m,
                fit.piece.to_m, fit.distances, fit.returns, fit.ray_order, fit.distance_order,
                kMmPerM * fit.rms_m, kMmPerM * fit.piece.sigma_m, 100 * fit.beyond_3_sigma);
  }
  append_line(out, "error: RMSE of the range before the fit; residual: after the fit");
  append_line(out, "(a normal distribution has 0.27 %% beyond 3 sigma)");
  if (!distances_known) {
    append_line(out,
                "The walls' distances are fitted to the same returns: a range bias is not "
                "observable.");
  }
  return out;
}

std::string noise_fragment(const RangeNoise& noise, bool with_table,
                           std::span<const calibration::WallPieceFit> walls) {
  std::string out = "{\n  \"lidar\": {\n    \"noise\": {\n";
  out += "      \"floor\": " + short_decimal(noise.plain.floor_m) + ",\n";
  out += "      \"share\": " + short_decimal(noise.plain.share) + ",\n";
  out += "      \"bearing\": " + short_decimal(noise.plain.bearing_rad);
  if (with_table) {
    out += ",\n      \"ranges\": [";
    std::string separator = "\n";
    for (const core::SigmaTable::Point& point : noise.table()) {
      out += separator + "        { \"range\": " + short_decimal(point.range_m) +
             ", \"sigma\": " + short_decimal(point.sigma_m) + " }";
      separator = ",\n";
    }
    out += "\n      ]";
  }
  if (!walls.empty()) append_wall_model(out, walls);
  return out + "\n    }\n  }\n}\n";
}

}  // namespace cornerd::tool
