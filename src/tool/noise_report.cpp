// SPDX-License-Identifier: MIT
#include "tool/noise_report.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <initializer_list>

#include "core/geometry/angle.hpp"

namespace cornerd::tool {

namespace {

using calibration::RangeCell;
using calibration::RangeNoise;

constexpr double kMmPerM = 1e3;

template <typename... Arguments>
void append_line(std::string& out, const char* format, Arguments... arguments) {
  char line[200];
  std::snprintf(line, sizeof line, format, arguments...);
  out += line;
  out += '\n';
}

/// Three digits are more than a calibration knows; without exponents, as people write them.
std::string short_decimal(double value) {
  const int digits = 2 - static_cast<int>(std::floor(std::log10(std::max(value, 1e-9))));
  char text[32];
  std::snprintf(text, sizeof text, "%.*f", std::clamp(digits, 0, 9), value);
  return text;
}

void append_cells(std::string& out, const RangeNoise& noise) {
  append_line(out, "%-13s %10s %10s %14s %10s %9s  %s", "range [m]", "directions", "sigma [mm]",
              "quartiles [mm]", "model [mm]", "residual", "with slant [mm]");
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
                100 * (cell.sigma_m / model_m - 1), kMmPerM * cell.as_met_m);
  }
}

}  // namespace

std::string describe_noise(const RangeNoise& noise) {
  std::string out;
  append_cells(out, noise);
  append_line(out, "");
  append_line(
      out, "model    sigma = max(%.2f mm, %.2f %% of the range); residual %.0f %% in the mean",
      kMmPerM * noise.plain.floor_m, 100 * noise.plain.share, 100 * std::expm1(noise.plain_misfit));
  if (noise.bearing_measured) {
    append_line(out, "bearing  %.3f degrees, from directions that meet their wall at a slant",
                core::degrees(noise.plain.bearing_rad));
  } else {
    append_line(out, "bearing  not measured (too few walls at a slant); %.3f degrees by default",
                core::degrees(noise.plain.bearing_rad));
  }
  append_line(out, "Nothing is known below %.2f m, where the nearest sigma is taken, and beyond",
              noise.cells.front().range_m);
  append_line(out,
              "%.2f m, where the farthest one's share of the range is; gaps are bridged straight.",
              noise.cells.back().range_m);
  return out;
}

std::string noise_fragment(const RangeNoise& noise, bool with_table) {
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
  return out + "\n    }\n  }\n}\n";
}

}  // namespace cornerd::tool
