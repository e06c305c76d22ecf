// SPDX-License-Identifier: MIT
#include "core/estimate/constant_velocity_model.hpp"

#include <cmath>

namespace cornerd::core {
namespace {

/// An older pose gives no prior.
constexpr double kMaxPriorAge_s = 2;
/// Two poses give a velocity where they are one or two scans apart and the speed is plausible for a
/// robot that carries an A1.
constexpr double kMinMotionTime_s = 0.03;
constexpr double kMaxMotionTime_s = 0.5;
constexpr double kMaxSpeed_m_s = 2;
constexpr double kMaxOmega_rad_s = 6;
/// A slower motion is noise of the two poses, and displaces no sample by what a lidar resolves.
constexpr double kRest_m_s = 0.01;
constexpr double kRest_rad_s = 0.01;
/// What a pose is off by at most: three sigma.
constexpr double kMaxSigmas = 3;
/// Before the first measurement.
constexpr double kUnknownSpeed_m_s = 0.5;
constexpr double kUnknownOmega_rad_s = 1.5;
/// Largest change of the velocity since the last pose.
constexpr double kAcceleration_m_s2 = 1;
constexpr double kAcceleration_rad_s2 = 4;
/// Two poses of a stationary robot differ by less than this, even before the bias is known.
constexpr double kMaxStationary_m_s = 0.03;
constexpr double kMaxStationary_rad_s = 0.03;

/// Updates a velocity's variance by the difference of two poses; returns the Kalman gain.
double update_gain(double& variance, double change, double sigma_of_a_pose) {
  variance += change * change;
  const double measurement = 2 * sigma_of_a_pose * sigma_of_a_pose;
  const double gain = variance / (variance + measurement);
  variance *= 1 - gain;
  return gain;
}

}  // namespace

void ConstantVelocityModel::update(const Pose2& T_map_lidar, TimeNs t_ns, const Twist2& motion,
                                   const Covariance3& covariance) {
  const double dt_s = to_seconds(t_ns - last_ns_);
  const Twist2 before = motion_;
  motion_ = deskewed_ ? Twist2{} : motion;
  is_stationary_ = false;
  sigma_m_ = std::sqrt((covariance(0, 0) + covariance(1, 1)) / 2);
  sigma_rad_ = std::sqrt(covariance(2, 2));
  if (!last_T_map_lidar_ || dt_s >= kMaxMotionTime_s) {
    variance_m2_s2_ = kUnknownSpeed_m_s * kUnknownSpeed_m_s;
    variance_rad2_s2_ = kUnknownOmega_rad_s * kUnknownOmega_rad_s;
  }
  if (last_T_map_lidar_ && dt_s > kMinMotionTime_s && dt_s < kMaxMotionTime_s) {
    const Twist2 measured = motion_between(*last_T_map_lidar_, T_map_lidar, dt_s);
    const bool moves =
        measured.speed_m_s() > kRest_m_s || std::abs(measured.omega_rad_s) > kRest_rad_s;
    if (is_plausible(measured)) {
      const double gain = update_gain(variance_m2_s2_, kAcceleration_m_s2 * dt_s, sigma_m_ / dt_s);
      const double gain_rad =
          update_gain(variance_rad2_s2_, kAcceleration_rad_s2 * dt_s, sigma_rad_ / dt_s);
      motion_ =
          moves
              ? Twist2{before.vx_m_s + gain * (measured.vx_m_s - before.vx_m_s),
                       before.vy_m_s + gain * (measured.vy_m_s - before.vy_m_s),
                       before.omega_rad_s + gain_rad * (measured.omega_rad_s - before.omega_rad_s)}
              : Twist2{};
    }
    is_stationary_ = measured.speed_m_s() < kMaxStationary_m_s &&
                     std::abs(measured.omega_rad_s) < kMaxStationary_rad_s;
  }
  last_T_map_lidar_ = T_map_lidar;
  last_ns_ = t_ns;
  has_pose_ = true;
}

void ConstantVelocityModel::forget() {
  expected_.reset();
  last_T_map_lidar_.reset();
  motion_ = {};
  is_stationary_ = false;
}

std::optional<Prior> ConstantVelocityModel::prior(TimeNs t_ns) const {
  if (expected_) return expected_;
  if (!last_T_map_lidar_) return std::nullopt;
  const double age_s = to_seconds(t_ns - last_ns_);
  if (std::abs(age_s) > kMaxPriorAge_s) return std::nullopt;
  return Prior{*last_T_map_lidar_ * motion_.over(age_s),
               kAcceleration_m_s2 * age_s * age_s / 2 + kMaxSigmas * sigma_m_,
               kAcceleration_rad_s2 * age_s * age_s / 2 + kMaxSigmas * sigma_rad_};
}

bool is_plausible(const Twist2& motion) {
  return motion.speed_m_s() < kMaxSpeed_m_s && std::abs(motion.omega_rad_s) < kMaxOmega_rad_s;
}

Eigen::Vector3d velocity_sigma(const Twist2& assumed, const Twist2& measured) {
  constexpr double kSteadyShare = 0.02;
  const auto sigma = [](double of_assumed, double of_measured) {
    return kSteadyShare * std::abs(of_assumed) + std::abs(of_measured - of_assumed);
  };
  return {sigma(assumed.vx_m_s, measured.vx_m_s), sigma(assumed.vy_m_s, measured.vy_m_s),
          sigma(assumed.omega_rad_s, measured.omega_rad_s)};
}

Covariance3 extrapolated_covariance(const Covariance3& covariance, double dt_s) {
  constexpr double kNominalScan_s = 0.14;
  const double scans = dt_s / kNominalScan_s;
  const double distance_m = kAcceleration_m_s2 * dt_s * dt_s / 2;
  const double angle_rad = kAcceleration_rad_s2 * dt_s * dt_s / 2;
  Covariance3 grown = (1 + 2 * scans * scans) * covariance;
  grown.diagonal() +=
      Eigen::Vector3d(distance_m * distance_m, distance_m * distance_m, angle_rad * angle_rad);
  return grown;
}

Covariance3 outdated_motion_covariance(double age_s, double duration_s) {
  // Typical of drives that reach 1 m/s and 6 rad/s within a second and keep their speed most of the
  // time.
  constexpr double kChange_m_s2 = 0.5;
  constexpr double kChange_rad_s2 = 2;
  const double position_m = kChange_m_s2 * age_s * duration_s / 2;
  const double rotation_rad = kChange_rad_s2 * age_s * duration_s / 2;
  return Eigen::Vector3d(position_m * position_m, position_m * position_m,
                         rotation_rad * rotation_rad)
      .asDiagonal();
}

Covariance3 covariance_of_base(const Covariance3& of_lidar, const Pose2& T_map_lidar,
                               const Pose2& T_map_base) {
  Covariance3 jacobian = Covariance3::Identity();
  jacobian(0, 2) = -(T_map_base.y_m - T_map_lidar.y_m);
  jacobian(1, 2) = T_map_base.x_m - T_map_lidar.x_m;
  return jacobian * of_lidar * jacobian.transpose();
}

}  // namespace cornerd::core
