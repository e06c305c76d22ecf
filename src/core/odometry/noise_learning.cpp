// SPDX-License-Identifier: MIT
#include "core/odometry/noise_learning.hpp"

#include "core/geometry/angle.hpp"
#include "core/geometry/squared.hpp"

namespace cornerd::core {
namespace {

/// A turn is deskewed by the same wheels that its fix is compared with: their noise within the
/// turns at both ends is missing. So many of them make that a small part.
constexpr int kFewestFixes = 4;
/// A window is as long as it takes for the noise to stand out among that of the fixes, or so long.
constexpr double kStandsOut = 2;
constexpr double kLongestWindow_s = 4;

}  // namespace

void NoiseLearning::drove(const OdometryIncrement& step, double wheel_rad2, double gyro_rad2,
                          bool slips) {
  if (step.is_gap) return interrupt();
  if (slips) by_wheels_.is_open = false;
  if (!step.has_gyro) by_gyro_.is_open = false;
  for (Window* window : {&by_wheels_, &by_gyro_}) {
    window->left_m += step.left_m;
    window->right_m += step.right_m;
    window->gyro_rad += step.gyro_rad;
    window->duration_s += step.duration_s();
  }
  by_wheels_.told_rad2 += wheel_rad2;
  by_gyro_.told_rad2 += gyro_rad2;
}

void NoiseLearning::fixed(double heading_rad, double variance_rad2,
                          const OdometryParameters& learned, const Covariance& covariance) {
  const auto is_due = [&](Window& window, double factor) {
    if (++window.fixes < kFewestFixes) return false;
    return factor * window.told_rad2 > kStandsOut * (window.variance_rad2 + variance_rad2) ||
           window.duration_s > kLongestWindow_s;
  };
  const auto begin = [&](Window& window) {
    window = {.is_open = true,
              .heading_rad = heading_rad,
              .variance_rad2 = variance_rad2,
              .learned = learned,
              .covariance = covariance};
  };
  if (by_wheels_.is_open && is_due(by_wheels_, wheel_factor())) {
    close_wheels(heading_rad, variance_rad2);
    by_wheels_.is_open = false;
  }
  if (by_gyro_.is_open && is_due(by_gyro_, gyro_factor())) {
    close_gyro(heading_rad, variance_rad2);
    by_gyro_.is_open = false;
  }
  if (!by_wheels_.is_open) begin(by_wheels_);
  if (!by_gyro_.is_open) begin(by_gyro_);
}

void NoiseLearning::interrupt() { by_wheels_.is_open = by_gyro_.is_open = false; }

void NoiseLearning::close_wheels(double heading_rad, double variance_rad2) {
  const Window& window = by_wheels_;
  const OdometryParameters& learned = window.learned;
  const double track_m = geometry_.track_m * (1 + learned.track_scale);
  const double left_m = window.left_m * (1 + learned.left_scale);
  const double right_m = window.right_m * (1 + learned.right_scale);
  const double rotation_rad = (right_m - left_m) / track_m;
  Slope slope;
  slope << 0, -window.left_m / track_m, window.right_m / track_m,
      -rotation_rad / (1 + learned.track_scale), 0;
  const double counts_rad2 = 4 * squared(geometry_.metres_per_count() / track_m) / 12;
  const double residual_rad =
      normalize_angle(angle_between(window.heading_rad, heading_rad) - rotation_rad);
  wheel_factor_.add(squared(residual_rad), window.told_rad2,
                    (slope * window.covariance * slope.transpose()).value() + counts_rad2 +
                        window.variance_rad2 + variance_rad2);
}

void NoiseLearning::close_gyro(double heading_rad, double variance_rad2) {
  const Window& window = by_gyro_;
  const OdometryParameters& learned = window.learned;
  const double gain = 1 + learned.gyro_scale;
  const double rotation_rad =
      (window.gyro_rad - learned.gyro_bias_rad_s * window.duration_s) / gain;
  Slope slope;
  slope << -window.duration_s / gain, 0, 0, 0, -rotation_rad / gain;
  const double residual_rad =
      normalize_angle(angle_between(window.heading_rad, heading_rad) - rotation_rad);
  gyro_factor_.add(squared(residual_rad), window.told_rad2,
                   (slope * window.covariance * slope.transpose()).value() + window.variance_rad2 +
                       variance_rad2);
}

}  // namespace cornerd::core
