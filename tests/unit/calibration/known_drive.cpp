// SPDX-License-Identifier: MIT
#include "known_drive.hpp"

namespace cornerd::calibration {

KnownDrive known_drive(const core::DriveGeometry& geometry, double rotations, bool with_gyro) {
  KnownDrive drive;
  core::Pose2 T_map_base{1, 2, 0.5};
  for (int i = 0; i < 3000; ++i) {
    if (i % 7 == 0) drive.places.push_back({i * core::TimeNs{20'000'000}, T_map_base});
    const double rate_rad_s = rotations * (i / 100 % 3 == 0 ? 0.0 : i / 100 % 3 == 1 ? 0.9 : -0.7);
    const double way_m = 0.4 * 0.02;
    const double rotation_rad = rate_rad_s * 0.02;
    T_map_base = T_map_base * core::arc(way_m, rotation_rad);
    const double half_m = rotation_rad * geometry.track_m * (1 + kKnownErrors.track_scale) / 2;
    core::OdometryIncrement step;
    step.from_ns = i * core::TimeNs{20'000'000};
    step.to_ns = step.from_ns + 20'000'000;
    step.left_m = (way_m - half_m) / (1 + kKnownErrors.left_scale);
    step.right_m = (way_m + half_m) / (1 + kKnownErrors.right_scale);
    step.gyro_rad =
        rotation_rad * (1 + kKnownErrors.gyro_scale) + kKnownErrors.gyro_bias_rad_s * 0.02;
    step.has_gyro = with_gyro;
    drive.steps.push_back(step);
  }
  return drive;
}

}  // namespace cornerd::calibration
