// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "core/map/ray_caster.hpp"
#include "core/map/wall_map.hpp"
#include "core/polar_scan.hpp"
#include "core/sensor_bias.hpp"
#include "core/sensor_noise.hpp"

namespace cornerd::core {

/// Estimates a lidar's bias online from scans at known poses: least squares of point-to-face
/// distances over each scan's pose and motion and one common bias. Pose and motion are eliminated
/// scan by scan (Schur complement), so that a scan leaves a 4 x 4 information matrix and
/// a steady motion within a scan does not pass for bias. Allocates nothing.
class BiasEstimator {
 public:
  /// `forgetting_rate`: share of the information dropped with each scan, since a lidar ages.
  BiasEstimator(double max_range_m, const SensorNoise& noise, const SensorBias& prior,
                double forgetting_rate = kForgettingRate);

  /// At 5.5 scans a second a third of the information is left after a minute.
  static constexpr double kForgettingRate = 0.003;

  /// The current estimate; the prior at first.
  const SensorBias& bias() const { return estimate_.bias; }
  /// Number of scans used.
  std::size_t scans() const { return estimate_.scans; }
  const EstimatedBias& estimate() const { return estimate_; }

  /// Continues from a stored estimate of the same lidar. Only its sigmas are stored, so that scale
  /// and offset are uncorrelated again.
  void resume(const EstimatedBias& estimate);

  /// Resets to the prior.
  void forget();

  /// What one scan tells of the bias: an information matrix, and that times the bias.
  struct Evidence {
    Eigen::Matrix4d information;
    Eigen::Vector4d weighted_bias;
  };
  /// `points`: of a scan of a robot at rest or nearly so, corrected by bias(), taken at
  /// `T_map_lidar`. Nullopt where they are too few.
  std::optional<Evidence> evidence(const WallMap& map, const Pose2& T_map_lidar,
                                   std::span<const PolarPoint> points, double noise_scale);
  void update(const Evidence& of_scan);
  /// The bias if that scan counted in full.
  SensorBias bias_by(const Evidence& of_scan) const;

 private:
  using Vector4 = Eigen::Vector4d;
  using Matrix4 = Eigen::Matrix4d;

  struct Posterior {
    Vector4 bias;
    Matrix4 covariance;
  };
  /// By scans of so much information, and the prior.
  Posterior posterior(const Matrix4& information, const Vector4& weighted_bias) const;
  void set_estimate(const Vector4& bias, const Matrix4& covariance);

  SensorNoise noise_;
  double retained_share_;
  RayCaster ray_caster_;
  std::vector<PolarPoint> few_;
  EstimatedBias estimate_;
  Vector4 prior_;
  Matrix4 information_ = Matrix4::Zero();  ///< of the scans, with exponential forgetting
  Vector4 evidence_ = Vector4::Zero();     ///< information times the bias it indicates
};

}  // namespace cornerd::core
