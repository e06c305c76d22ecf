// SPDX-License-Identifier: MIT
// What a window of a recorded drive is off by, and how little one counts that is off by much more.
#pragma once

#include <cmath>

namespace cornerd::calibration {

/// What two places and a second of wheels and gyro are off by.
inline constexpr double kPlaceSigma_m = 0.004;
inline constexpr double kWheelRotationSigma_rad = 0.015;
inline constexpr double kGyroRotationSigma_rad = 0.003;
/// Cauchy: a residual of so many sigmas counts half; one of a slip hardly at all.
inline constexpr double kHalfWeightSigmas = 2;

/// Of a residual in sigmas.
inline double tamed_weight(double r) {
  return 1 / (1 + r * r / (kHalfWeightSigmas * kHalfWeightSigmas));
}
/// In place of its square.
inline double tamed_square(double r) {
  constexpr double kWidth = kHalfWeightSigmas * kHalfWeightSigmas;
  return kWidth * std::log1p(r * r / kWidth);
}
/// How fast what it pulls with grows with it.
inline double tamed_slope(double r) {
  const double weight = tamed_weight(r);
  return weight * (2 * weight - 1);
}

/// Tukey's biweight, once the residuals' own sigma is known: one of so many sigmas counts nothing.
/// A slip always adds counts, so that whatever little all slips weigh is a bias.
inline constexpr double kNoWeightSigmas = 4.685;

inline double sharp_weight(double r) {
  const double rest = 1 - r * r / (kNoWeightSigmas * kNoWeightSigmas);
  return rest > 0 ? rest * rest : 0;
}
/// How fast what it pulls with grows with it.
inline double sharp_slope(double r) {
  const double share = r * r / (kNoWeightSigmas * kNoWeightSigmas);
  return share < 1 ? (1 - share) * (1 - 5 * share) : 0;
}

}  // namespace cornerd::calibration
