// SPDX-License-Identifier: MIT
#include "core/estimate/bias_estimator.hpp"

#include <algorithm>
#include <cmath>

#include "core/geometry/linear_solve.hpp"

namespace cornerd::core {
namespace {

/// Prior standard deviations of an A1's bias: scale, offset [m], both parts of the bearing [rad].
const Eigen::Vector4d kPriorSigma(0.01, 0.005, radians(0.3), radians(0.3));
/// Larger deviations from the prior mean a wrong map, not a wrong sensor.
const Eigen::Vector4d kLimit(0.03, 0.02, radians(1.5), radians(1.5));
/// Prior standard deviations of the motion of a robot that seems to stand, own axes: m/s, rad/s.
const Eigen::Vector3d kMotionSigma(0.5, 0.5, 1);
/// Share of a scan's information that counts: map errors exceed the point noise and repeat in every
/// scan from one place.
constexpr double kScanShare = 0.05;
constexpr double kCut = 4;
constexpr std::size_t kMinPoints = 60;
/// At least so many points of a scan stand for all (the row of a biased lidar in src/bench/poses.md
/// is none the worse for it).
constexpr std::size_t kFewPoints = 200;

Eigen::Vector4d vector_of(const SensorBias& bias) {
  return {bias.range_scale, bias.range_offset_m, bias.bearing_sine_rad, bias.bearing_cosine_rad};
}

SensorBias bias_of(const Eigen::Vector4d& vector) {
  return {vector[0], vector[1], vector[2], vector[3]};
}

Eigen::Vector4d prior_information() { return kPriorSigma.cwiseAbs2().cwiseInverse(); }

}  // namespace

BiasEstimator::BiasEstimator(double max_range_m, const SensorNoise& noise, const SensorBias& prior,
                             double forgetting_rate)
    : noise_(noise),
      retained_share_(1 - forgetting_rate),
      ray_caster_(max_range_m),
      prior_(vector_of(prior)) {
  few_.reserve(2 * kFewPoints);
  estimate_.bias = prior;
}

void BiasEstimator::forget() {
  estimate_ = {};
  estimate_.bias = bias_of(prior_);
  information_.setZero();
  evidence_.setZero();
}

void BiasEstimator::resume(const EstimatedBias& estimate) {
  forget();
  const Vector4 sigma = vector_of(estimate.sigma);
  if (estimate.scans == 0 || !(sigma.minCoeff() > 0)) return;
  const Vector4 prior = prior_information();
  const Vector4 observed = (sigma.cwiseAbs2().cwiseInverse() - prior).cwiseMax(0);
  information_ = observed.asDiagonal();
  set_estimate(vector_of(estimate.bias), sigma.cwiseAbs2().asDiagonal());
  evidence_ =
      (observed + prior).cwiseProduct(vector_of(estimate_.bias)) - prior.cwiseProduct(prior_);
  estimate_.scans = estimate.scans;
}

void BiasEstimator::set_estimate(const Vector4& bias, const Matrix4& covariance) {
  const Vector4 limited = bias.cwiseMax(prior_ - kLimit).cwiseMin(prior_ + kLimit);
  estimate_.bias = bias_of(limited);
  estimate_.is_limited = limited != bias;
  estimate_.sigma = bias_of(covariance.diagonal().cwiseSqrt());
}

std::optional<BiasEstimator::Evidence> BiasEstimator::evidence(const WallMap& map,
                                                               const Pose2& T_map_lidar,
                                                               std::span<const PolarPoint> points,
                                                               double noise_scale) {
  const std::size_t stride = take_few(points, kFewPoints, few_);
  const auto hits = ray_caster_.cast(map, T_map_lidar, few_);
  const double c = std::cos(T_map_lidar.theta_rad);
  const double s = std::sin(T_map_lidar.theta_rad);
  Eigen::Matrix<double, 10, 10> information = Eigen::Matrix<double, 10, 10>::Zero();
  Eigen::Matrix<double, 10, 1> gradient = Eigen::Matrix<double, 10, 1>::Zero();
  std::size_t used = 0;
  for (std::size_t i = 0; i < few_.size(); ++i) {
    if (hits[i].face == PredictedHit::kNone) continue;
    const PolarPoint& point = few_[i];
    const Face& face = map.faces()[hits[i].face];
    // All in the lidar's frame.
    const Vec2 normal(c * face.normal.x() + s * face.normal.y(),
                      c * face.normal.y() - s * face.normal.x());
    const double height_m = face.normal.dot(T_map_lidar.translation()) - face.offset_m;
    const double distance_m = normal.x() * point.x_m + normal.y() * point.y_m + height_m;
    const double along_ray = normal.x() * point.ray_x + normal.y() * point.ray_y;
    const double across_ray = normal.y() * point.ray_x - normal.x() * point.ray_y;
    // The gate is wider than the noise: residuals still contain the bias.
    const double variance =
        noise_.variance_across_m2(point.range_m, std::abs(along_ray)) * noise_scale * noise_scale;
    const double share = 1 - distance_m * distance_m / (kCut * kCut * (variance + 1e-4));
    if (share <= 0) continue;
    Eigen::Matrix<double, 10, 1> jacobian;
    const Eigen::Vector3d of_pose(normal.x(), normal.y(), point.range_m * across_ray);
    jacobian << of_pose, point.dt_s * of_pose, point.range_m * along_ray, along_ray,
        point.range_m * across_ray * point.ray_y, point.range_m * across_ray * point.ray_x;
    const double weight = share * share / variance;
    information.noalias() += weight * jacobian * jacobian.transpose();
    gradient.noalias() += weight * distance_m * jacobian;
    ++used;
  }
  if (stride * used < kMinPoints) return std::nullopt;
  information *= static_cast<double>(stride);
  gradient *= static_cast<double>(stride);

  information.diagonal().segment<3>(3) += kMotionSigma.cwiseAbs2().cwiseInverse();
  const SymmetricSolver<6> of_turn(information.topLeftCorner<6, 6>());
  if (!of_turn.succeeded() || !of_turn.is_positive()) return std::nullopt;
  const Eigen::Matrix<double, 6, 4> coupled = information.topRightCorner<6, 4>();
  const Eigen::Matrix<double, 6, 4> solved = of_turn.solve_columns(coupled);
  const Matrix4 of_bias = information.bottomRightCorner<4, 4>() - coupled.transpose() * solved;
  const Vector4 reduced_gradient = gradient.tail<4>() - solved.transpose() * gradient.head<6>();
  if (!of_bias.allFinite() || !reduced_gradient.allFinite()) return std::nullopt;
  return Evidence{of_bias, of_bias * vector_of(estimate_.bias) + reduced_gradient};
}

BiasEstimator::Posterior BiasEstimator::posterior(const Matrix4& information,
                                                  const Vector4& weighted_bias) const {
  const Vector4 prior = prior_information();
  const Matrix4 sum = information + Matrix4(prior.asDiagonal());
  const Matrix4 covariance = SymmetricSolver<4>(sum).inverse();
  return {covariance * (weighted_bias + prior.cwiseProduct(prior_)), covariance};
}

SensorBias BiasEstimator::bias_by(const Evidence& of_scan) const {
  return bias_of(
      posterior(information_ + of_scan.information, evidence_ + of_scan.weighted_bias).bias);
}

void BiasEstimator::update(const Evidence& of_scan) {
  information_ = retained_share_ * information_ + kScanShare * of_scan.information;
  evidence_ = retained_share_ * evidence_ + kScanShare * of_scan.weighted_bias;
  const auto [best, covariance] = posterior(information_, evidence_);
  if (!best.allFinite() || !(covariance.diagonal().minCoeff() > 0)) return;
  set_estimate(best, covariance);
  ++estimate_.scans;
}

}  // namespace cornerd::core
