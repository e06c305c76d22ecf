// SPDX-License-Identifier: MIT
// Medians, and the weights of robust least squares.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace cornerd::calibration {

/// Sigma of a normal distribution over its median absolute deviation.
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

/// Sigmas of a window of about a second: two lidar poses, wheels and gyro.
inline constexpr double kPoseSigma_m = 0.004;
inline constexpr double kWheelRotationSigma_rad = 0.015;
inline constexpr double kGyroRotationSigma_rad = 0.003;
/// Cauchy: a residual of this many sigmas has half the weight.
inline constexpr double kHalfWeightSigmas = 2;

/// `r`: a residual in sigmas.
inline double cauchy_weight(double r) {
  return 1 / (1 + r * r / (kHalfWeightSigmas * kHalfWeightSigmas));
}
/// Replaces the squared residual.
inline double cauchy_cost(double r) {
  constexpr double kWidth = kHalfWeightSigmas * kHalfWeightSigmas;
  return kWidth * std::log1p(r * r / kWidth);
}
/// Derivative of weight times residual.
inline double cauchy_curvature(double r) {
  const double weight = cauchy_weight(r);
  return weight * (2 * weight - 1);
}

/// Tukey's biweight: a residual of this many sigmas has no weight. Slips always add counts, so that
/// any weight of them is a bias.
inline constexpr double kNoWeightSigmas = 4.685;

inline double tukey_weight(double r) {
  const double rest = 1 - r * r / (kNoWeightSigmas * kNoWeightSigmas);
  return rest > 0 ? rest * rest : 0;
}
/// Derivative of weight times residual.
inline double tukey_curvature(double r) {
  const double share = r * r / (kNoWeightSigmas * kNoWeightSigmas);
  return share < 1 ? (1 - share) * (1 - 5 * share) : 0;
}

}  // namespace cornerd::calibration
