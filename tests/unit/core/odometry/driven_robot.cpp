// SPDX-License-Identifier: MIT
#include "driven_robot.hpp"

#include <algorithm>
#include <cmath>

namespace cornerd::core::testing {

OdometryReading DrivenRobot::drive(double dt_s, double speed_m_s, double rate_rad_s) {
  // Fine enough for the half-angle step to be exact.
  constexpr int kParts = 10;
  const double rate_before_rad_s = rate_rad_s_;
  rate_rad_s_ = rate_rad_s;
  for (int i = 0; i < kParts; ++i) {
    const double share = (i + 0.5) / kParts;
    const double rotation_rad =
        (rate_before_rad_s + share * (rate_rad_s - rate_before_rad_s)) * dt_s / kParts;
    const double way_m = speed_m_s * dt_s / kParts;
    T_map_base_ = T_map_base_ * Pose2{way_m * std::cos(rotation_rad / 2),
                                      way_m * std::sin(rotation_rad / 2), rotation_rad};
  }
  const double half_m = (rate_before_rad_s + rate_rad_s) / 2 * dt_s * geometry_.track_m *
                        (1 + errors_.track_scale) / 2;
  const auto rolled = [&](double way_m, double scale) {
    return (way_m + errors_.wheel_m_per_sqrt_m * std::sqrt(std::abs(way_m)) * normal()) /
           (1 + scale);
  };
  left_m_ += rolled(speed_m_s * dt_s - half_m, errors_.left_scale);
  right_m_ += rolled(speed_m_s * dt_s + half_m, errors_.right_scale);
  now_ns_ += from_seconds(dt_s);

  const auto counts = [&](double way_m) {
    const auto count = static_cast<std::int64_t>(std::floor(way_m / geometry_.metres_per_count()));
    return geometry_.counter_max > 0 ? count & geometry_.counter_max : count;
  };
  const double noise_rad_s = errors_.gyro_rad_s_per_sqrt_hz / std::sqrt(dt_s) * normal();
  return {now_ns_, counts(left_m_), counts(right_m_),
          rate_rad_s * (1 + errors_.gyro_scale) + errors_.gyro_bias_rad_s + noise_rad_s};
}

Rates lively_drive(double t_s) {
  struct Leg {
    double until_s;
    Rates rates;
  };
  constexpr Leg kLegs[] = {{3, {0.4, 0}},      {5, {0.3, 0.8}},   {6, {0, -1.5}},
                           {8.5, {0.5, -0.4}}, {9.5, {0.2, 1.2}}, {10, {0, 0}}};
  constexpr double kRamp_s = 0.25;
  const double phase_s = std::fmod(t_s, 10);
  Rates before;
  double since_s = 0;
  for (const Leg& leg : kLegs) {
    if (phase_s < leg.until_s) {
      const double share = std::min(1.0, (phase_s - since_s) / kRamp_s);
      return {before.speed_m_s + share * (leg.rates.speed_m_s - before.speed_m_s),
              before.rate_rad_s + share * (leg.rates.rate_rad_s - before.rate_rad_s)};
    }
    before = leg.rates;
    since_s = leg.until_s;
  }
  return {};
}

}  // namespace cornerd::core::testing
