// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

#include <Eigen/Core>

#include "core/geometry/angle.hpp"

namespace cornerd::core {

using Vec2 = Eigen::Vector2d;

/// Twice the signed area of the triangle (0, a, b): positive where b lies counter-clockwise of a.
inline double cross(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }
inline Vec2 rotate_left(const Vec2& v) { return {-v.y(), v.x()}; }
inline Vec2 unit_vector(double angle_rad) { return {std::cos(angle_rad), std::sin(angle_rad)}; }
/// Counter-clockwise from x, in [-pi, pi].
inline double angle_of(const Vec2& direction) { return std::atan2(direction.y(), direction.x()); }

/// A rigid transform of the plane, element of SE(2): `T_a_b * p_b` is the point p_b of frame b in
/// frame a.
struct Pose2 {
  double x_m = 0;
  double y_m = 0;
  double theta_rad = 0;  ///< in (-pi, pi]

  Vec2 translation() const { return {x_m, y_m}; }

  Vec2 operator*(const Vec2& point) const {
    const double c = std::cos(theta_rad);
    const double s = std::sin(theta_rad);
    return {x_m + c * point.x() - s * point.y(), y_m + s * point.x() + c * point.y()};
  }

  Pose2 operator*(const Pose2& other) const {
    const Vec2 moved = *this * other.translation();
    return {moved.x(), moved.y(), normalize_angle(theta_rad + other.theta_rad)};
  }

  Pose2 inverse() const {
    const double c = std::cos(theta_rad);
    const double s = std::sin(theta_rad);
    return {-c * x_m - s * y_m, s * x_m - c * y_m, normalize_angle(-theta_rad)};
  }

  bool operator==(const Pose2&) const = default;
};

/// Velocity of a frame in its own axes.
struct Twist2 {
  double vx_m_s = 0;
  double vy_m_s = 0;
  double omega_rad_s = 0;

  /// Displacement at constant velocity: an arc, the exponential map of SE(2).
  Pose2 over(double dt_s) const {
    const double rotation_rad = omega_rad_s * dt_s;
    double along = 1 - rotation_rad * rotation_rad / 6;  // sin(rotation) / rotation
    double aside = rotation_rad / 2;                     // (1 - cos(rotation)) / rotation
    if (std::abs(rotation_rad) > kNearlyStraight_rad) {
      along = std::sin(rotation_rad) / rotation_rad;
      aside = (1 - std::cos(rotation_rad)) / rotation_rad;
    }
    return {(along * vx_m_s - aside * vy_m_s) * dt_s, (aside * vx_m_s + along * vy_m_s) * dt_s,
            normalize_angle(rotation_rad)};
  }
  static constexpr double kNearlyStraight_rad = 1e-3;
  double speed_m_s() const { return std::hypot(vx_m_s, vy_m_s); }
  Twist2 operator+(const Twist2& other) const {
    return {vx_m_s + other.vx_m_s, vy_m_s + other.vy_m_s, omega_rad_s + other.omega_rad_s};
  }
  bool operator==(const Twist2&) const = default;
  bool is_rest() const { return vx_m_s == 0 && vy_m_s == 0 && omega_rad_s == 0; }
};

/// Motion within a scan: the velocity at the time that the scan is deskewed to, and how the yaw
/// rate changes. A robot that begins to rotate reaches 6 rad/s^2, by which the ends of a scan of
/// 0.14 s are turned by 0.8 degrees more than at constant velocity.
struct ScanMotion {
  ScanMotion() = default;
  ScanMotion(const Twist2& velocity, double acceleration_rad_s2 = 0)
      : twist(velocity), alpha_rad_s2(acceleration_rad_s2) {}

  Twist2 twist;
  double alpha_rad_s2 = 0;

  double rotation_rad(double dt_s) const {
    return (twist.omega_rad_s + alpha_rad_s2 / 2 * dt_s) * dt_s;
  }
  ScanMotion operator+(const ScanMotion& other) const {
    return {twist + other.twist, alpha_rad_s2 + other.alpha_rad_s2};
  }
  bool operator==(const ScanMotion&) const = default;
  bool is_rest() const { return twist.is_rest() && alpha_rad_s2 == 0; }
};

/// The constant velocity that leads from one pose to the other in `dt_s`: the inverse of over(),
/// for rotations below pi.
inline Twist2 motion_between(const Pose2& from, const Pose2& to, double dt_s) {
  const Pose2 displacement = from.inverse() * to;
  const double half_rad = displacement.theta_rad / 2;
  const double along = std::abs(half_rad) > Twist2::kNearlyStraight_rad
                           ? half_rad / std::tan(half_rad)
                           : 1 - half_rad * half_rad / 3;
  return {(along * displacement.x_m + half_rad * displacement.y_m) / dt_s,
          (along * displacement.y_m - half_rad * displacement.x_m) / dt_s,
          displacement.theta_rad / dt_s};
}

/// Of (x [m], y [m], theta [rad]) in the frame of the pose; symmetric.
using Covariance3 = Eigen::Matrix3d;

/// True where both poses agree within the given distance and angle.
inline bool same_pose(const Pose2& a, const Pose2& b, double distance_m, double angle_rad) {
  return (a.translation() - b.translation()).squaredNorm() < distance_m * distance_m &&
         std::abs(angle_between(a.theta_rad, b.theta_rad)) < angle_rad;
}

}  // namespace cornerd::core
