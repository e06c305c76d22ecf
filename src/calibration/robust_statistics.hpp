// SPDX-License-Identifier: MIT
// What a window of a recorded drive is off by, and how little one counts that is off by much more.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace cornerd::calibration {

/// Of a normal distribution: sigma over the median of the absolute values.
inline constexpr double kMedianToSigma = 1.4826;

/// The value that `share` of the values do not exceed; 0 for none. Reorders its copy.
inline double quantile(std::vector<double> values, double share) {
  if (values.empty()) return 0;
  const auto rank = static_cast<std::size_t>(share * static_cast<double>(values.size() - 1) + 0.5);
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(rank);
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

struct Weighted {
  double value = 0;
  double weight = 0;
};

/// The value with half of the weight below it; 0 for none.
inline double weighted_median(std::vector<Weighted> values) {
  std::sort(values.begin(), values.end(),
            [](const Weighted& a, const Weighted& b) { return a.value < b.value; });
  double whole = 0;
  for (const Weighted& value : values) whole += value.weight;
  double sum = 0;
  for (const Weighted& value : values) {
    sum += value.weight;
    if (2 * sum >= whole) return value.value;
  }
  return 0;
}

inline double median(std::vector<double> values) { return quantile(std::move(values), 0.5); }

/// What two places and a second of wheels and gyro are off by.
inline constexpr double kPlaceSigma_m = 0.004;
inline constexpr double kWheelRotationSigma_rad = 0.015;
inline constexpr double kGyroRotationSigma_rad = 0.003;
/// Cauchy: a residual of so many sigmas counts half; one of a slip hardly at all.
inline constexpr double kHalfWeightSigmas = 2;

/// Of a residual in sigmas.
inline double cauchy_weight(double r) {
  return 1 / (1 + r * r / (kHalfWeightSigmas * kHalfWeightSigmas));
}
/// In place of its square.
inline double cauchy_cost(double r) {
  constexpr double kWidth = kHalfWeightSigmas * kHalfWeightSigmas;
  return kWidth * std::log1p(r * r / kWidth);
}
/// How fast what it pulls with grows with it.
inline double cauchy_curvature(double r) {
  const double weight = cauchy_weight(r);
  return weight * (2 * weight - 1);
}

/// Tukey's biweight, once the residuals' own sigma is known: one of so many sigmas counts nothing.
/// A slip always adds counts, so that whatever little all slips weigh is a bias.
inline constexpr double kNoWeightSigmas = 4.685;

inline double tukey_weight(double r) {
  const double rest = 1 - r * r / (kNoWeightSigmas * kNoWeightSigmas);
  return rest > 0 ? rest * rest : 0;
}
/// How fast what it pulls with grows with it.
inline double tukey_curvature(double r) {
  const double share = r * r / (kNoWeightSigmas * kNoWeightSigmas);
  return share < 1 ? (1 - share) * (1 - 5 * share) : 0;
}

}  // namespace cornerd::calibration
