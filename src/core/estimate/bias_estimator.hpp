// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include <Eigen/Core>

#include "core/map/ray_caster.hpp"
#include "core/map/wall_map.hpp"
#include "core/polar_scan.hpp"
#include "core/sensor_bias.hpp"
#include "core/sensor_noise.hpp"

namespace cornerd::core {

/// Learns a lidar's bias from the turns whose place is known: least squares of the points'
/// distances to their walls over the pose and the motion of each turn and one bias for all of them.
/// Pose and motion are eliminated turn by turn (Schur complement), so that a turn leaves a 4 x 4
/// matrix behind, whatever its size, and a robot that starts or stops within it teaches no bias
/// that is none. Allocates nothing.
class BiasEstimator {
 public:
  /// `forgotten_share`: of what was learnt, with each turn: a lidar ages.
  BiasEstimator(double max_range_m, const SensorNoise& noise, const SensorBias& known,
                double forgotten_share = kForgottenShare);

  /// A minute at 5.5 turns a second keeps a third.
  static constexpr double kForgottenShare = 0.003;

  /// What is believed so far; `known` at first.
  const SensorBias& bias() const { return learned_.bias; }
  /// Turns that it was learnt from.
  std::size_t scans() const { return learned_.scans; }
  const LearnedBias& learned() const { return learned_; }

  /// Goes on from what another one learnt of the same lidar. Of its doubt no more than the sigmas
  /// is known: scale and offset may trade with each other again.
  void resume(const LearnedBias& learned);

  /// Back to what was known at first.
  void forget();

  /// `points`: of a turn of a robot at rest or nearly so, corrected by bias(), seen from
  /// `T_map_lidar`.
  void learn(const WallMap& map, const Pose2& T_map_lidar, std::span<const PolarPoint> points,
             double noise_scale);

 private:
  using Vector4 = Eigen::Vector4d;
  using Matrix4 = Eigen::Matrix4d;

  void believe(const Vector4& bias, const Matrix4& covariance);

  SensorNoise noise_;
  double kept_share_;
  RayCaster prediction_;
  LearnedBias learned_;
  Vector4 known_;
  Matrix4 information_ = Matrix4::Zero();  ///< that turns gave, fading
  Vector4 evidence_ = Vector4::Zero();     ///< information times the bias that they speak for
};

}  // namespace cornerd::core
