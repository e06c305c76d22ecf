// SPDX-License-Identifier: MIT
#include "core/estimate/map_error_model.hpp"

#include <algorithm>
#include <cmath>

#include "core/geometry/linear_solve.hpp"
#include "core/geometry/squared.hpp"
#include "core/map/wall_map.hpp"

namespace cornerd::core {
namespace {

/// Moments of Tukey's biweight cut at four sigma, for normal residuals: the variance of the
/// weighted sum of distances, and the derivative of that sum by the face's own displacement, both
/// divided by the sum of the weights. E[(1 - z^2/16)^4 z^2] = 0.513 and E[(1 - z^2/16) (1 - 5
/// z^2/16)] = 0.684 over E[(1 - z^2/16)^2] = 0.887.
constexpr double kNoiseShare = 0.579;
constexpr double kShiftShare = 0.771;

/// Before the first scan half of all maps are exact, the others measured with a tape.
constexpr double kTape_m = FloorPlan::kMeasuredSigma_m;
/// The roughness of real surfaces: offsets that are less are none.
constexpr double kExact_m = 0.003;
/// Exponential forgetting with each scan: three seconds.
constexpr double kRetained = 0.95;

/// Log likelihood of the faces' residuals if each face has an offset of this variance, or each end
/// of a face, over that without any, nats. Pose, offsets and directions are marginalised:
/// `information` is the pose's without them, at which the gradient is zero.
double log_likelihood(std::span<const FaceResidual> residuals, const Eigen::Matrix3d& information,
                      double variance_m2, bool by_ends = false) {
  if (!(variance_m2 > 0)) return 0;
  Eigen::Matrix3d reduced = information;
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
  double chi_square = 0;
  double log_determinant = 0;
  for (const FaceResidual& face : residuals) {
    if (!(face.weight > 0)) continue;
    const double share = 1 / (face.weight + 1 / variance_m2);
    const double distance = face.distance / kShiftShare;
    reduced -= share * face.gradient() * face.gradient().transpose();
    gradient += share * distance * face.gradient();
    chi_square -= share * squared(distance);
    log_determinant += std::log1p(variance_m2 * face.weight);
    if (!by_ends) continue;
    const double variance = face.direction_variance(std::sqrt(variance_m2));
    const LineSums::Eliminated eliminated = face.eliminate_direction(variance);
    reduced(2, 2) -= eliminated.information;
    gradient.z() += eliminated.gradient / kShiftShare;
    chi_square -= eliminated.chi_square / squared(kShiftShare);
    log_determinant += std::log1p(variance * face.direction_weight());
  }
  const SymmetricSolver<3> solver(reduced);
  const double ratio = solver.pivots().prod() / SymmetricSolver<3>(information).pivots().prod();
  if (!solver.is_positive() || !(ratio > 0)) return 0;
  chi_square -= gradient.dot(solver.solve(gradient));
  return -(chi_square + log_determinant + std::log(ratio)) / 2;
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
  for (const FaceResidual& face : residuals) {
    if (!(face.weight > 0)) continue;
    const Eigen::Vector3d gradient = face.gradient();
    // Leverage of the face: the share of its displacement that the pose absorbs.
    const double leverage = gradient.dot(covariance * gradient) / face.weight;
    const double noise = kNoiseShare * (1 - leverage);
    statistics.excess += squared(face.distance) / face.weight - noise;
    statistics.excess_variance += 2 * squared(noise);
    statistics.excess_per_variance += squared(kShiftShare) * face.weight * (1 - leverage);
  }
  return statistics;
}

Covariance3 covariance_per_variance(std::span<const FaceResidual> residuals,
                                    const Covariance3& covariance) {
  Covariance3 squared_gradients = Covariance3::Zero();
  for (const FaceResidual& face : residuals) {
    squared_gradients += face.gradient() * face.gradient().transpose();
  }
  return covariance * squared_gradients * covariance;
}

double log_odds_of_tape(std::span<const FaceResidual> residuals, const Covariance3& covariance,
                        double shown_m2) {
  if (shown_m2 >= squared(kTape_m)) return 0;
  const Eigen::Matrix3d information = inverse(covariance);
  const double as_a_whole = log_likelihood(residuals, information, squared(kTape_m));
  const double by_ends = log_likelihood(residuals, information, squared(kTape_m), true);
  const double of_tape =
      std::max(as_a_whole, by_ends) + std::log((1 + std::exp(-std::abs(as_a_whole - by_ends))) / 2);
  return of_tape - log_likelihood(residuals, information, shown_m2);
}

double FaceResidualStatistics::shown_variance_m2() const {
  if (!(excess_per_variance > 0)) return 0;
  return std::max(0.0, excess - std::sqrt(excess_variance)) / excess_per_variance;
}

double FaceResidualStatistics::variance_m2() const {
  if (!(excess_per_variance > 0)) return 0;
  const double shown_m2 = shown_variance_m2();
  const double p_tape = 1 / (1 + std::exp(-log_odds_of_tape));
  return shown_m2 + p_tape * std::max(0.0, squared(kTape_m) - shown_m2);
}

bool FaceResidualStatistics::excludes_offsets() const {
  return excess_per_variance > 0 && variance_m2() < squared(kExact_m);
}

void MapErrorModel::add(const FaceResidualStatistics& statistics) {
  sum_.excess = kRetained * sum_.excess + statistics.excess;
  sum_.excess_variance = squared(kRetained) * sum_.excess_variance + statistics.excess_variance;
  sum_.excess_per_variance = kRetained * sum_.excess_per_variance + statistics.excess_per_variance;
  if (!(sum_.excess_per_variance > 0)) return;
  sum_.log_odds_of_tape += (statistics.log_odds_of_tape - sum_.log_odds_of_tape) *
                           statistics.excess_per_variance / sum_.excess_per_variance;
}

Covariance3 MapErrorModel::pose_covariance(const FaceResidualStatistics& statistics) const {
  return variance_m2() * statistics.covariance_per_variance;
}

}  // namespace cornerd::core
