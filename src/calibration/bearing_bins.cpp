// SPDX-License-Identifier: MIT
#include "calibration/bearing_bins.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "calibration/robust_statistics.hpp"
#include "core/geometry/angle.hpp"

namespace cornerd::calibration {
namespace {

constexpr std::size_t kBins = 720;
constexpr std::size_t kWidest = 8;               ///< of them in one
constexpr std::size_t kMaxReturnsPerBin = 4000;  ///< ten minutes of an A1
/// A sigma of ten samples is good to a quarter; the fits use many bins.
constexpr std::size_t kMinReturns = 10;
/// Share of the bins with statistics from which on bins are not widened.
constexpr double kEnoughBins = 0.5;

constexpr double kGateSigmas = 3;
/// Sigma of a normal distribution truncated at 3 sigma.
constexpr double kCutAtThreeSigma = 0.9866;
/// Coarsest range step of an A1; the smallest outlier gate.
constexpr double kStepM = 0.001;
/// Returns farther than this from the median of their bin are outliers.
constexpr double kOtherThingM = 0.05;
constexpr double kOtherThingShare = 0.1;
constexpr int kGateRounds = 4;

struct StraightLine {
  double bearing_rad = 0;
  double range_m = 0;
  double slope_m = 0;

  double residual(const Return& point) const {
    return point.range_m - range_m - slope_m * (point.bearing_rad - bearing_rad);
  }
};

StraightLine fit_line(const std::vector<Return>& points) {
  StraightLine line;
  for (const Return& point : points) {
    line.bearing_rad += point.bearing_rad;
    line.range_m += point.range_m;
  }
  line.bearing_rad /= static_cast<double>(points.size());
  line.range_m /= static_cast<double>(points.size());
  double xx = 0;
  double xy = 0;
  for (const Return& point : points) {
    const double x = point.bearing_rad - line.bearing_rad;
    xx += x * x;
    xy += x * (point.range_m - line.range_m);
  }
  // Devices that number their beams give all returns of a bin the same bearing.
  constexpr double kOneBearing = 1e-12;
  if (xx > kOneBearing * static_cast<double>(points.size())) line.slope_m = xy / xx;
  return line;
}

double drift_of(const StraightLine& line, const std::vector<Return>& kept, double sigma_m) {
  const std::size_t half = kept.size() / 2;
  double sum_m = 0;
  for (std::size_t i = 0; i < 2 * half; ++i) {
    sum_m += (i < half ? -1 : 1) * line.residual(kept[i]);
  }
  return sigma_m > 0 ? sum_m / (sigma_m * static_cast<double>(half)) : 0;
}

std::vector<Return> near_median(const std::vector<Return>& all) {
  std::vector<double> ranges;
  for (const Return& point : all) ranges.push_back(point.range_m);
  const double middle_m = median(ranges);
  std::vector<Return> near;
  for (const Return& point : all) {
    const double off_m = std::abs(point.range_m - middle_m);
    if (off_m <= kOtherThingM + kOtherThingShare * middle_m) near.push_back(point);
  }
  return near;
}

std::optional<BinSpread> spread_of(const std::vector<Return>& all) {
  if (all.size() < kMinReturns) return std::nullopt;
  std::vector<Return> kept = near_median(all);
  StraightLine line;
  for (int round = 0; round < kGateRounds; ++round) {
    if (kept.size() < kMinReturns) return std::nullopt;
    line = fit_line(kept);
    std::vector<double> off_m;
    for (const Return& point : kept) off_m.push_back(std::abs(line.residual(point)));
    const double gate_m = std::max(kGateSigmas * kMedianToSigma * median(off_m), kStepM);
    kept.clear();
    for (const Return& point : all) {
      if (std::abs(line.residual(point)) <= gate_m) kept.push_back(point);
    }
  }
  if (kept.size() < kMinReturns) return std::nullopt;
  line = fit_line(kept);
  double squares = 0;
  for (const Return& point : kept) squares += std::pow(line.residual(point), 2);
  BinSpread spread;
  spread.bearing_rad = line.bearing_rad;
  spread.range_m = line.range_m;
  spread.slope_m = line.slope_m;
  spread.sigma_m = std::sqrt(squares / static_cast<double>(kept.size() - 2)) / kCutAtThreeSigma;
  spread.drift = drift_of(line, kept, spread.sigma_m);
  spread.returns = kept.size();
  spread.rejected = 1 - static_cast<double>(kept.size()) / static_cast<double>(all.size());
  return spread;
}

/// A bin is too narrow for a good slope. Where both neighbours lie on the same wall, their ranges
/// give it several times better.
void take_slopes_from_neighbours(std::vector<BinSpread>& spreads, double width_rad) {
  const std::vector<BinSpread> own = spreads;
  for (std::size_t i = 1; i + 1 < own.size(); ++i) {
    const BinSpread& before = own[i - 1];
    const BinSpread& after = own[i + 1];
    const double apart_rad = after.bearing_rad - before.bearing_rad;
    if (apart_rad > 3 * width_rad || apart_rad < width_rad) continue;
    const double slope_m = (after.range_m - before.range_m) / apart_rad;
    const double expected_m = before.range_m + slope_m * (own[i].bearing_rad - before.bearing_rad);
    const double gate_m = std::max(own[i].sigma_m, kStepM);
    if (std::abs(own[i].range_m - expected_m) <= gate_m) spreads[i].slope_m = slope_m;
  }
}

}  // namespace

BearingBins::BearingBins() : bins_(kBins) {}

void BearingBins::add(double bearing_rad, double range_m) {
  if (!(range_m > 0) || !std::isfinite(bearing_rad)) return;
  const double revolution = core::normalize_angle(bearing_rad) / core::kTwoPi + 0.5;
  const auto bin = std::min(static_cast<std::size_t>(revolution * kBins), kBins - 1);
  if (bins_[bin].size() >= kMaxReturnsPerBin) return;
  bins_[bin].push_back(
      {static_cast<float>(core::normalize_angle(bearing_rad)), static_cast<float>(range_m)});
  ++returns_;
}

std::vector<Return> BearingBins::all() const {
  std::vector<Return> all;
  all.reserve(returns_);
  for (const auto& bin : bins_) all.insert(all.end(), bin.begin(), bin.end());
  return all;
}

std::vector<BinSpread> BearingBins::spreads_of_width(std::size_t bins) const {
  std::vector<BinSpread> spreads;
  for (std::size_t first = 0; first < kBins; first += bins) {
    std::vector<Return> returns;
    for (std::size_t i = first; i < first + bins; ++i) {
      returns.insert(returns.end(), bins_[i].begin(), bins_[i].end());
    }
    if (const auto spread = spread_of(returns)) spreads.push_back(*spread);
  }
  take_slopes_from_neighbours(spreads, core::kTwoPi * static_cast<double>(bins) / kBins);
  return spreads;
}

std::vector<BinSpread> BearingBins::spreads() const {
  for (std::size_t width = 1; width < kWidest; width *= 2) {
    std::size_t seen = 0;
    for (std::size_t first = 0; first < kBins; first += width) {
      const auto begin = bins_.begin() + static_cast<std::ptrdiff_t>(first);
      seen += std::any_of(begin, begin + static_cast<std::ptrdiff_t>(width),
                          [](const auto& bin) { return !bin.empty(); });
    }
    std::vector<BinSpread> spreads = spreads_of_width(width);
    if (static_cast<double>(spreads.size()) >= kEnoughBins * static_cast<double>(seen)) {
      return spreads;
    }
  }
  return spreads_of_width(kWidest);
}

}  // namespace cornerd::calibration
