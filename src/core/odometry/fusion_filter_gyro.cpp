// SPDX-License-Identifier: MIT
// What the gyro says of a step of the wheels.
#include <algorithm>
#include <cmath>

#include "core/geometry/squared.hpp"
#include "core/odometry/fusion_prediction.hpp"

namespace cornerd::core {
namespace {

/// Wheels and gyro that differ by more than this, squared and in units of what they may, do so
/// because a wheel slips: four sigma.
constexpr double kSlip = 16;
/// A gyro that is right but for its scale is off by a smaller share of a turn.
constexpr double kGross = 0.3;
/// Where one wheel slips the other is not quite sure either: this share of the slip's variance.
constexpr double kSlipOfOther = 0.03;
/// Two wheels, two ends of a step, and as much again.
constexpr double kCountsForJitter = 8;

}  // namespace

void FusionFilter::expect_of_gyro(Prediction& p) const {
  p.gyro_told_rad2 = squared(noise_.gyro_rad_s_per_sqrt_hz) * p.dt_s;
  // Readings that come late or early count a rate for too long or too short; the wheels' counts do
  // not mind. Unreckoned with, it looks like slip, and what is made of that drives the scales away.
  // Counts change sides with every reading as well.
  const double rate_rad_s = p.dt_s > 0 ? p.step.gyro_rad / p.dt_s : 0;
  const double counts_rad2 =
      kCountsForJitter * geometry_.quantization_variance() / squared(p.track_m);
  p.jitter_rad2 = std::max(0.0, 2 * jitter_.variance_s2() * squared(rate_rad_s) - counts_rad2);
  // When within the step the rate changed nobody knows: evenly between its two ends.
  p.gyro_rad2 = p.gyro_told_rad2 * learning_.gyro_factor() + squared(p.step.gyro_change_rad) / 3 +
                p.jitter_rad2;
}

void FusionFilter::compare_with_gyro(Prediction& p) {
  const double known_rad2 = variance_along(p.seen_by) + p.gyro_rad2;
  const double expected_rad2 = known_rad2 + squared(p.gyro_gain) * p.rotation_variance;
  jitter_.add(p.surprise_rad, p.step.gyro_rad / p.dt_s, expected_rad2 - p.jitter_rad2);
  p.slips = squared(p.surprise_rad) > kSlip * expected_rad2;
  const double rotations_rad =
      std::max(std::abs(p.moved.wheel_rotation_rad), std::abs(p.step.gyro_rad - p.bias_rad));
  slip_watch_.add(squared(rotations_rad) > kSlip * expected_rad2, p.slips, p.dt_s);
  const bool is_gross = p.slips && std::abs(p.surprise_rad) > kGross * rotations_rad;
  if (is_gross && (!gyro_is_believed_ || p.step.gyro_may_be_stuck)) slip_watch_.contradict();
  if (p.slips) {
    // One of the wheels did not do what its counts say, most likely the one that says more; the
    // gyro does not slip. With that wheel in doubt, the gyro tells its way as well.
    ++slips_;
    const double slip_m2 = squared(p.surprise_rad / p.gyro_gain * p.track_m);
    (std::abs(p.moved.left_m) > std::abs(p.moved.right_m) ? p.left_m2 : p.right_m2) += slip_m2;
    p.left_m2 += kSlipOfOther * slip_m2;
    p.right_m2 += kSlipOfOther * slip_m2;
    p.rotation_variance += (1 + 2 * kSlipOfOther) * slip_m2 / squared(p.track_m);
  }
  // What the scales do to the turn is taken at what wheels and gyro together say, and what they do
  // to the surprise at the motion of the steps before: with a step's own noise in the slope as well
  // as in the surprise the scales are biased (by 1 % in
  // tests/unit/core/odometry/fusion_filter_test.cpp, and without end on a circle).
  const double both_rad =
      p.moved.wheel_rotation_rad + p.gyro_gain * (p.rotation_variance + p.old_rests_rad2) /
                                       (known_rad2 + squared(p.gyro_gain) * p.rotation_variance) *
                                       p.surprise_rad;
  if (p.slips) {
    p.course_rad = state_[kTheta] + both_rad / 2;
    p.follows = 0;
  }
  // Where no count has come there is nothing that a scale could have scaled, but noise.
  const bool is_counted = p.step.left_m != 0 || p.step.right_m != 0;
  if (!is_counted) {
    p.turn_by = turn_slope(0, 0, p.rolls);
    p.usual_by = p.seen_by = seen_slope(p.turn_by, 0, p.dt_s);
    return;
  }
  const Motion itself{p.moved.translation_m, both_rad, p.dt_s};
  const Motion before = usual_.of(itself);
  p.turn_by = turn_slope(p.moved.translation_m, both_rad, p.rolls);
  p.seen_by = seen_slope(p.turn_by, both_rad, p.dt_s);
  p.usual_by = seen_slope(turn_slope(before.way_m, before.rotation_rad, p.rolls),
                          before.rotation_rad, p.dt_s);
  usual_.add(itself);
}

FusionFilter::Row FusionFilter::seen_slope(const Row& turn_by, double rotation_rad,
                                           double dt_s) const {
  Row slope = (1 + state_[kGyro]) * turn_by;
  slope[kBias] += dt_s;
  slope[kGyro] += rotation_rad;
  return slope;
}

}  // namespace cornerd::core
