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

/// A chi-square of so many degrees of freedom, over its mean, that is less once in 20 times (Wilson
/// and Hilferty 1931).
double least_share(double freedom) {
  constexpr double kOnceIn20 = 1.645;
  const double variance = 2 / (9 * freedom);
  const double root = 1 - variance - kOnceIn20 * std::sqrt(variance);
  return freedom > 0 && root > 0 ? root * root * root : 0;
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
  for (const FaceResidual& face : residuals) {
    if (!(face.weight > 0)) continue;
    const Eigen::Vector3d gradient = face.gradient();
    // Leverage of the face: the share of its displacement that the pose absorbs.
    const double leverage = gradient.dot(covariance * gradient) / face.weight;
    const double noise = kNoiseShare * (1 - leverage);
    statistics.excess += squared(face.distance) / face.weight - noise;
    statistics.excess_variance += 2 * squared(noise);
    statistics.excess_per_variance += squared(kShiftShare) * face.weight * (1 - leverage);
    statistics.freedom += 1 - leverage;
    squared_gradients += gradient * gradient.transpose();
  }
  statistics.covariance_per_variance = covariance * squared_gradients * covariance;
  return statistics;
}

void MapErrorModel::add(const FaceResidualStatistics& statistics) {
  excess_ = kRetained * excess_ + statistics.excess;
  excess_variance_ = squared(kRetained) * excess_variance_ + statistics.excess_variance;
  excess_per_variance_ = kRetained * excess_per_variance_ + statistics.excess_per_variance;
  freedom_ = std::max(kRetained * freedom_, statistics.freedom);
}

double MapErrorModel::variance() const {
  // Without this margin half of all scans show some excess by chance.
  const double excess = excess_ - std::sqrt(excess_variance_);
  return excess > 0 && excess_per_variance_ > 0 ? excess / excess_per_variance_ : 0;
}

bool MapErrorModel::is_exact() const {
  return excess_per_variance_ > 0 &&
         excess_ + 2 * std::sqrt(excess_variance_) <
             least_share(freedom_) * squared(kExact_m) * excess_per_variance_;
}

Covariance3 MapErrorModel::pose_covariance(const FaceResidualStatistics& statistics) const {
  return std::min(variance(), squared(kMostOff_m)) * statistics.covariance_per_variance;
}

}  // namespace cornerd::core
