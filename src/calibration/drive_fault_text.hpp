// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "calibration/drive_faults.hpp"
#include "core/odometry/odometry_config.hpp"

namespace cornerd::calibration {

/// What the remedies of faults name.
struct OdometryNames {
  core::DriveGeometry geometry{};
  core::Pose2 T_base_lidar{};     ///< as configured
  bool is_kernel = false;         ///< the board's own encoders and gyro; else ODOMETRY lines
  bool left_is_reversed = false;  ///< by the config of the kernel's encoders and gyro
  bool right_is_reversed = false;
  bool gyro_is_reversed = false;
};

/// "wheels-swapped", "mount-theta" ...
std::string_view name_of(const DriveHypothesis& hypothesis);
std::string_view name_of(const GyroHypothesis& hypothesis);

/// The names of all faults that cannot be told apart, best first: wheels and mount, then the gyro.
std::vector<std::string_view> names_of(const DriveFaults& faults);

/// What is wrong, or all that may be, and how to mend it; empty where nothing is.
std::string describe(const DriveFaults& faults, const OdometryNames& names);

}  // namespace cornerd::calibration
