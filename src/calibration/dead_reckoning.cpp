// SPDX-License-Identifier: MIT
#include "calibration/dead_reckoning.hpp"

#include <cmath>

namespace cornerd::calibration {
namespace {

double unless_small(double change_rad, double dead_band_rad) {
  return std::abs(change_rad) < dead_band_rad ? 0 : change_rad;
}

/// The way of a wheel whose angle must change by more than the dead band to count.
double counted(double way_m, double radius_m, double dead_band_rad) {
  return unless_small(way_m / radius_m, dead_band_rad) * radius_m;
}

}  // namespace

double heading_change(const core::OdometryIncrement& step, const core::DriveGeometry& geometry,
                      const DeadReckoningConfig& config) {
  const double radius_m = geometry.wheel_radius_m;
  const double left_m = counted(step.left_m, radius_m, config.factors.dead_band_rad);
  const double right_m = counted(step.right_m, radius_m, config.factors.dead_band_rad);
  const double encoder_rad = (right_m - left_m) / geometry.track_m;
  const double by_encoder = config.factors.encoder_factor * encoder_rad;
  const double by_gyro = config.factors.gyro_factor * step.gyro_rad;
  double change_rad = by_encoder;
  if (step.has_gyro) {
    switch (config.source) {
      case HeadingSource::kEncoder:
        break;
      case HeadingSource::kGyro:
        change_rad = by_gyro;
        break;
      case HeadingSource::kMean:
        change_rad = (encoder_rad + step.gyro_rad) / 2;
        break;
      case HeadingSource::kWeighted:
      case HeadingSource::kFilter:
        change_rad = (by_encoder + by_gyro) / 2;
        break;
    }
  }
  return unless_small(change_rad, config.factors.dead_band_rad);
}

core::OdometryIncrement by_wheels_alone(const core::OdometryIncrement& step,
                                        const core::DriveGeometry& geometry,
                                        const DeadReckoningConfig& config) {
  const double radius_m = geometry.wheel_radius_m;
  const double dead_band_rad = config.factors.dead_band_rad;
  const double way_m = (counted(step.left_m, radius_m, dead_band_rad) +
                        counted(step.right_m, radius_m, dead_band_rad)) /
                       2;
  const double half_m = heading_change(step, geometry, config) * geometry.track_m / 2;
  core::OdometryIncrement alone = step;
  alone.left_m = way_m - half_m;
  alone.right_m = way_m + half_m;
  alone.has_gyro = false;
  return alone;
}

const core::Pose2& DeadReckoning::add(const core::OdometryIncrement& step) {
  const core::OdometryIncrement alone = by_wheels_alone(step, geometry_, config_);
  T_start_base_ = T_start_base_ * core::arc(alone.translation_m(),
                                            (alone.right_m - alone.left_m) / geometry_.track_m);
  return T_start_base_;
}

}  // namespace cornerd::calibration
