// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <numbers>

namespace cornerd::core {

inline constexpr double kPi = std::numbers::pi;
inline constexpr double kTwoPi = 2 * std::numbers::pi;

constexpr double radians(double degrees) { return degrees * (kPi / 180); }
constexpr double degrees(double radians) { return radians * (180 / kPi); }

/// The same direction in (-pi, pi] (REP 103). Finite input only.
inline double normalize_angle(double angle_rad) {
  if (angle_rad > -kPi && angle_rad <= kPi) return angle_rad;
  const double wrapped = angle_rad - kTwoPi * std::ceil((angle_rad - kPi) / kTwoPi);
  // Several revolutions plus a half, rounded, may end beyond kPi.
  return wrapped > -kPi && wrapped < kPi ? wrapped : kPi;
}

/// Rotation from `from_rad` to `to_rad` by the shorter way, in (-pi, pi].
inline double angle_between(double from_rad, double to_rad) {
  return normalize_angle(to_rad - from_rad);
}

}  // namespace cornerd::core
