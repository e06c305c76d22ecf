// SPDX-License-Identifier: MIT
#include "core/estimate/pose_memory.hpp"

#include <cmath>

namespace cornerd::core {
namespace {

/// A pose older than this is no prior any more.
constexpr double kMaxPriorAge_s = 2;
/// Two poses tell the motion between them where they are one or two turns apart, and the robot did
/// not jump: nobody who needs an A1 is faster.
constexpr double kMinMotionTime_s = 0.03;
constexpr double kMaxMotionTime_s = 0.5;
constexpr double kMaxSpeed_m_s = 2;
constexpr double kMaxOmega_rad_s = 6;
/// A motion below this is the noise of two poses, and moves no sample by what a lidar could tell.
constexpr double kRest_m_s = 0.01;
constexpr double kRest_rad_s = 0.01;
/// Whatever it did before, it may have changed it by this since.
constexpr double kAcceleration_m_s2 = 1;
constexpr double kAcceleration_rad_s2 = 4;
/// Two poses of a robot that stands may differ by this, of a lidar whose bias is not known yet.
constexpr double kStanding_m_s = 0.03;
constexpr double kStanding_rad_s = 0.03;

}  // namespace

void PoseMemory::remember(const Pose2& T_map_lidar, TimeNs t_ns, const Twist2& motion) {
  const double dt_s = to_seconds(t_ns - last_ns_);
  motion_ = straightened_ ? Twist2{} : motion;
  stands_ = false;
  if (last_T_map_lidar_ && dt_s > kMinMotionTime_s && dt_s < kMaxMotionTime_s) {
    const Twist2 seen = motion_between(*last_T_map_lidar_, T_map_lidar, dt_s);
    const bool moves = seen.speed_m_s() > kRest_m_s || std::abs(seen.omega_rad_s) > kRest_rad_s;
    if (is_plausible(seen)) motion_ = moves ? seen : Twist2{};
    stands_ = seen.speed_m_s() < kStanding_m_s && std::abs(seen.omega_rad_s) < kStanding_rad_s;
  }
  last_T_map_lidar_ = T_map_lidar;
  last_ns_ = t_ns;
  ever_ = true;
}

void PoseMemory::forget() {
  expected_.reset();
  last_T_map_lidar_.reset();
  motion_ = {};
  stands_ = false;
}

std::optional<Prior> PoseMemory::prior(TimeNs t_ns) const {
  if (expected_) return expected_;
  if (!last_T_map_lidar_) return std::nullopt;
  const double age_s = to_seconds(t_ns - last_ns_);
  if (std::abs(age_s) > kMaxPriorAge_s) return std::nullopt;
  return Prior{*last_T_map_lidar_ * motion_.over(age_s), kAcceleration_m_s2 * age_s * age_s / 2,
               kAcceleration_rad_s2 * age_s * age_s / 2};
}

bool is_plausible(const Twist2& motion) {
  return motion.speed_m_s() < kMaxSpeed_m_s && std::abs(motion.omega_rad_s) < kMaxOmega_rad_s;
}

Covariance3 doubt_of_motion(const Twist2& used, const Twist2& seen) {
  constexpr double kHalfTurn_s = 0.07;
  constexpr double kSteadyShare = 0.02;
  constexpr double kChangeShare = 0.25;
  const Twist2 change = seen + Twist2{-used.vx_m_s, -used.vy_m_s, -used.omega_rad_s};
  const auto variance = [](double steady, double changed) {
    const double doubt = kHalfTurn_s * (kSteadyShare * steady + kChangeShare * changed);
    return doubt * doubt;
  };
  const double place_m2 = variance(used.speed_m_s(), change.speed_m_s());
  return Eigen::Vector3d(place_m2, place_m2,
                         variance(std::abs(used.omega_rad_s), std::abs(change.omega_rad_s)))
      .asDiagonal();
}

Covariance3 later(const Covariance3& covariance, double dt_s) {
  constexpr double kNominalScan_s = 0.14;
  const double scans = dt_s / kNominalScan_s;
  const double way_m = kAcceleration_m_s2 * dt_s * dt_s / 2;
  const double way_rad = kAcceleration_rad_s2 * dt_s * dt_s / 2;
  Covariance3 grown = (1 + 2 * scans * scans) * covariance;
  grown.diagonal() += Eigen::Vector3d(way_m * way_m, way_m * way_m, way_rad * way_rad);
  return grown;
}

Covariance3 doubt_of_old_motion(double age_s, double duration_s) {
  // Of drives that take up 1 m/s and 6 rad/s in a second, and keep their speed most of the time.
  constexpr double kChange_m_s2 = 0.5;
  constexpr double kChange_rad_s2 = 2;
  const double place_m = kChange_m_s2 * age_s * duration_s / 2;
  const double rotation_rad = kChange_rad_s2 * age_s * duration_s / 2;
  return Eigen::Vector3d(place_m * place_m, place_m * place_m, rotation_rad * rotation_rad)
      .asDiagonal();
}

Covariance3 covariance_of_base(const Covariance3& of_lidar, const Pose2& T_map_lidar,
                               const Pose2& T_map_base) {
  Covariance3 slope = Covariance3::Identity();
  slope(0, 2) = -(T_map_base.y_m - T_map_lidar.y_m);
  slope(1, 2) = T_map_base.x_m - T_map_lidar.x_m;
  return slope * of_lidar * slope.transpose();
}

}  // namespace cornerd::core
