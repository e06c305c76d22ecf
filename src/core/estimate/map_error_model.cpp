// SPDX-License-Identifier: MIT
#include "core/estimate/map_error_model.hpp"

#include <algorithm>
#include <cmath>

#include "core/geometry/squared.hpp"

namespace cornerd::core {
namespace {

/// Moments of Tukey's biweight cut at four sigma, for normal residuals: the variance of the
/// weighted sum of distances, and the derivative of that sum by the face's own displacement, both
/// divided by the sum of the weights. E[(1 - z^2/16)^4 z^2] = 0.513 and E[(1 - z^2/16) (1 - 5
/// z^2/16)] = 0.684 over E[(1 - z^2/16)^2] = 0.887.
constexpr double kNoiseShare = 0.579;
constexpr double kShiftShare = 0.771;

constexpr double kExact_m = 0.005;

/// Exponential forgetting with each scan: three seconds.
constexpr double kRetained = 0.95;

/// A chi-square of so many degrees of freedom, over its mean, that is less once in 20 times: below
/// three by the leading term of its series, else by Wilson and Hilferty (1931); both meet there.
double least_share(double freedom) {
  constexpr double kOnceIn20 = 1.645;
  if (!(freedom > 0)) return 0;
  if (freedom < 3) {
    return 2 * std::pow(std::tgamma(freedom / 2 + 1) / 20, 2 / freedom) / freedom;
  }
  const double variance = 2 / (9 * freedom);
  const double root = 1 - variance - kOnceIn20 * std::sqrt(variance);
  return root * root * root;
}

}  // namespace

void merge_by_face(std::vector<FaceResidual>& residuals) {
  std::sort(
      residuals.begin(), residuals.end(),
      [](const FaceResidual& one, const FaceResidual& other) { return one.face < other.face; });
  std::size_t faces = 0;
  for (const FaceResidual& residual : residuals) {
    if (faces > 0 && residuals[faces - 1].face == residual.face) {
      residuals[faces - 1].add(residual);
    } else {
      residuals[faces++] = residual;
    }
  }
  residuals.resize(faces);
}

FaceResidualStatistics face_residual_statistics(std::span<const FaceResidual> residuals,
                                                const Covariance3& covariance) {
  FaceResidualStatistics statistics;
  Covariance3 squared_gradients = Covariance3::Zero();
  // Of the quadratic form that the excess is in the faces' displacements, of which the pose absorbs
  // what it can: W - G C G', one row of G a face's gradient.
  double trace = 0;
  double trace_of_square = 0;
  for (const FaceResidual& face : residuals) {
    if (!(face.weight > 0)) continue;
    const Eigen::Vector3d gradient = face.gradient();
    // Leverage of the face: the share of its displacement that the pose absorbs.
    const double leverage = gradient.dot(covariance * gradient) / face.weight;
    const double noise = kNoiseShare * (1 - leverage);
    statistics.excess += squared(face.distance) / face.weight - noise;
    statistics.excess_variance += 2 * squared(noise);
    statistics.excess_per_variance += squared(kShiftShare) * face.weight * (1 - leverage);
    trace += face.weight * (1 - leverage);
    trace_of_square += squared(face.weight) * (1 - 2 * leverage);
    squared_gradients += gradient * gradient.transpose();
  }
  const Covariance3 absorbed = covariance * squared_gradients;
  trace_of_square += (absorbed * absorbed).trace();
  statistics.freedom = trace_of_square > 0 ? squared(trace) / trace_of_square : 0;
  statistics.covariance_per_variance = covariance * squared_gradients * covariance;
  return statistics;
}

bool FaceResidualStatistics::excludes_offsets() const {
  return excess_per_variance > 0 &&
         excess + 2 * std::sqrt(excess_variance) <
             least_share(freedom) * squared(kExact_m) * excess_per_variance;
}

void MapErrorModel::add(const FaceResidualStatistics& statistics) {
  sum_.excess = kRetained * sum_.excess + statistics.excess;
  sum_.excess_variance = squared(kRetained) * sum_.excess_variance + statistics.excess_variance;
  sum_.excess_per_variance = kRetained * sum_.excess_per_variance + statistics.excess_per_variance;
  sum_.freedom = std::max(kRetained * sum_.freedom, statistics.freedom);
}

double MapErrorModel::variance() const {
  // Without this margin half of all scans show some excess by chance.
  const double excess = sum_.excess - std::sqrt(sum_.excess_variance);
  return excess > 0 && sum_.excess_per_variance > 0 ? excess / sum_.excess_per_variance : 0;
}

Covariance3 MapErrorModel::pose_covariance(const FaceResidualStatistics& statistics) const {
  return std::min(variance(), squared(kMostOff_m)) * statistics.covariance_per_variance;
}

}  // namespace cornerd::core
