// SPDX-License-Identifier: MIT
#include "calibration/range_noise.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "calibration/robust_statistics.hpp"

namespace cornerd::calibration {
namespace {

/// Narrow where an A1's noise changes fastest; includes the paper's limits, 0.6 and 1 m.
constexpr std::array kEdgesM = {0.0, 0.3, 0.45, 0.6, 0.8, 1.0, 1.25, 1.5, 2.0,
                                2.5, 3.0, 4.0,  5.0, 6.0, 8.0, 10.0, 12.5};
constexpr double kNearestM = 0.15;  ///< smallest range of an A1
constexpr std::size_t kMinBinsPerCell = 12;
constexpr double kFlat = 0.577;     ///< tangent of 30 degrees
constexpr double kSteep = 0.839;    ///< of 40 degrees
constexpr double kTooSteep = 2.75;  ///< of 70 degrees: the beam's footprint dominates there
constexpr std::size_t kMinSteepBins = 12;
/// Half a distance step of a standard node: quantisation.
constexpr double kMinSigmaM = 0.000125;
/// Relative sigma of the range variance interpolated in the table.
constexpr double kRangeVarianceSigma = 0.2;
constexpr double kMaxBearingRad = 0.05;
constexpr int kFitRounds = 20;

bool is_flat(const BinSpread& bin) { return std::abs(bin.steepness()) < kFlat; }
bool is_steep(const BinSpread& bin) {
  return std::abs(bin.steepness()) >= kSteep && std::abs(bin.steepness()) < kTooSteep;
}

/// At least half of the bin's sigma: a bin whose sigma is small by chance would give zero.
double without_bearing(const BinSpread& bin, double bearing_rad) {
  const double aside_m = bin.slope_m * bearing_rad;
  const double all = bin.sigma_m * bin.sigma_m;
  return std::max(std::sqrt(std::max(all - aside_m * aside_m, all / 4)), kMinSigmaM);
}

RangeCell make_cell(std::span<const BinSpread> bins, double from_m, double to_m,
                    double bearing_rad) {
  std::vector<double> ranges;
  std::vector<double> sigmas;
  std::vector<double> as_met;
  for (const BinSpread& bin : bins) {
    if (bin.range_m < from_m || bin.range_m >= to_m) continue;
    as_met.push_back(bin.sigma_m);
    if (!is_flat(bin)) continue;
    ranges.push_back(bin.range_m);
    sigmas.push_back(without_bearing(bin, bearing_rad));
  }
  return {from_m,
          to_m,
          median(ranges),
          median(sigmas),
          quantile(sigmas, 0.25),
          quantile(sigmas, 0.75),
          median(as_met),
          sigmas.size()};
}

/// A cell reaches from an edge to the nearest one that gives it enough bins, within twice the
/// range.
std::vector<RangeCell> make_cells(std::span<const BinSpread> bins, double bearing_rad) {
  std::vector<RangeCell> cells;
  for (std::size_t first = 0; first + 1 < kEdgesM.size(); ++first) {
    const double limit_m = 2 * std::max(kEdgesM[first], kNearestM);
    for (std::size_t last = first + 1; last < kEdgesM.size(); ++last) {
      const RangeCell cell = make_cell(bins, kEdgesM[first], kEdgesM[last], bearing_rad);
      if (cell.bins >= kMinBinsPerCell) {
        cells.push_back(cell);
        first = last - 1;
        break;
      }
      if (kEdgesM[last] >= limit_m) break;
    }
  }
  return cells;
}

std::vector<core::SigmaTable::Point> points_of(std::span<const RangeCell> cells) {
  std::vector<core::SigmaTable::Point> points;
  for (const RangeCell& cell : cells) points.push_back({cell.range_m, cell.sigma_m});
  return points;
}

/// Bearing sigma from the steep bins' variance beyond the range's. `bearing_rad`: the last iterate.
/// Nullopt where there are too few.
std::optional<double> bearing_noise(std::span<const BinSpread> bins,
                                    const core::SigmaTable& range_noise, double bearing_rad) {
  std::vector<Weighted> squares;
  for (const BinSpread& bin : bins) {
    if (!is_steep(bin)) continue;
    const double all = bin.sigma_m * bin.sigma_m;
    const double along = std::pow(range_noise.sigma_m(bin.range_m), 2);
    const double slope = bin.slope_m * bin.slope_m;
    // Weights by the modelled variance: weights by the measured one would prefer small values.
    const double modelled = along + slope * bearing_rad * bearing_rad;
    const double sigma = std::hypot(modelled * std::sqrt(2.0 / static_cast<double>(bin.returns)),
                                    kRangeVarianceSigma * along);
    squares.push_back({(all - along) / slope, slope / sigma});
  }
  if (squares.size() < kMinSteepBins) return std::nullopt;
  return std::min(std::sqrt(std::max(weighted_median(squares), 0.0)), kMaxBearingRad);
}

/// Weighted mean over the cells of |log(measured / model)|; robust against single cells.
double log_residual(std::span<const RangeCell> cells, double floor_m, double share) {
  double sum = 0;
  double weights = 0;
  for (const RangeCell& cell : cells) {
    const double model_m = std::max(floor_m, share * cell.range_m);
    const double weight = std::sqrt(static_cast<double>(cell.bins));
    sum += weight * std::abs(std::log(cell.sigma_m / model_m));
    weights += weight;
  }
  return sum / weights;
}

void fit_floor_and_share(std::span<const RangeCell> cells, RangeNoise& fit) {
  // Logarithmic grids, the second one around the best of the first.
  constexpr int kSteps = 40;
  double floor_m = 0.0016;  // geometric middles of 0.1 mm .. 25 mm and 0.0002 .. 0.1
  double share = 0.0045;
  fit.plain_residual = log_residual(cells, floor_m, share);
  double reach = std::log(25.0);
  for (int round = 0; round < 3; ++round) {
    const double middle_floor_m = floor_m;
    const double middle_share = share;
    for (int i = -kSteps; i <= kSteps; ++i) {
      for (int j = -kSteps; j <= kSteps; ++j) {
        const double try_floor_m = middle_floor_m * std::exp(reach * i / kSteps);
        const double try_share = middle_share * std::exp(reach * j / kSteps);
        const double found = log_residual(cells, try_floor_m, try_share);
        if (found >= fit.plain_residual) continue;
        fit.plain_residual = found;
        floor_m = try_floor_m;
        share = try_share;
      }
    }
    reach *= 2.0 / kSteps;
  }
  // Outside the cells: the nearest cell's sigma, and the farthest cell's share, as in the table.
  fit.plain.floor_m = std::max(floor_m, share * cells.front().range_m);
  fit.plain.share = std::max(share, floor_m / cells.back().range_m);
}

}  // namespace

bool RangeNoise::is_of_walls() const {
  constexpr double kMaxShare = 0.1;
  return std::all_of(cells.begin(), cells.end(), [](const RangeCell& cell) {
    return cell.sigma_m <= kMaxShare * cell.range_m;
  });
}

std::vector<core::SigmaTable::Point> RangeNoise::table() const { return points_of(cells); }

std::optional<RangeNoise> fit_range_noise(std::span<const BinSpread> bins) {
  RangeNoise fit;
  double bearing_rad = 0;
  for (int round = 0; round < kFitRounds; ++round) {
    fit.cells = make_cells(bins, bearing_rad);
    if (fit.cells.empty()) return std::nullopt;
    const auto found = bearing_noise(bins, core::SigmaTable(fit.table()), bearing_rad);
    fit.bearing_measured = found.has_value();
    bearing_rad = found.value_or(0);
  }
  if (fit.bearing_measured) fit.plain.bearing_rad = bearing_rad;
  fit_floor_and_share(fit.cells, fit);
  return fit;
}

}  // namespace cornerd::calibration
