// SPDX-License-Identifier: MIT
#pragma once

#include "calibration/drive_fault_text.hpp"
#include "settings/config.hpp"

namespace cornerd::settings {

/// What the remedies of a drive's faults name in this config.
inline calibration::OdometryNames odometry_names(const Config& config) {
  const drivers::KernelOdometryConfig& kernel = config.odometry.kernel;
  return {config.odometry.core.geometry,
          config.localizer().T_base_lidar,
          config.odometry.source == OdometrySource::kKernel,
          kernel.left.reversed,
          kernel.right.reversed,
          kernel.gyro.reversed};
}

}  // namespace cornerd::settings
