// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>

#include <Eigen/Core>

#include "calibration/motion_window.hpp"
#include "core/geometry/pose2.hpp"

namespace cornerd::calibration {

/// Relative error of wheels and track that a user measured, as the motion filter begins with for
/// the track. Larger ones are faults.
inline constexpr double kMeasuredSigma = 0.05;

/// A window's motion by wheels whose wiring a hypothesis supposes.
struct WheelTravel {
  double left_m = 0;
  double right_m = 0;
};

/// What a hypothesis predicts, and which wheels it trusts.
struct DriveModel {
  core::DriveGeometry configured{};  ///< of the noise: quantization, and of rotations
  double track_m = 0;
  core::Pose2 T_base_lidar;  ///< prior
  core::Pose2 mount_sigma;
  bool trusts_left = true;
  bool trusts_right = true;
};

/// Maximum of the posterior of mount and scales (Gauss-Newton in the EM algorithm: each
/// residual is an inlier or one of the motions of any robot), with the logarithm of the evidence by
/// Laplace's method.
struct DriveFit {
  core::Pose2 T_base_lidar;
  core::Pose2 sigma;
  double log_evidence = 0;
  double reduced_chi_square = 0;  ///< of the residuals; each counts for at most 9
};

/// `travel`: of each window.
DriveFit fit_drive_model(std::span<const MotionWindow> windows, std::span<const WheelTravel> travel,
                         const DriveModel& model);

/// Rotation by the gyro: rotation = share * gyro + rest * duration.
struct GyroModel {
  double share = 1;
  double bias_sigma_rad_s = 0.05;
  std::size_t delay = 0;  ///< of kDelays_s
  bool trusts_gyro = true;
};

struct GyroFit {
  double share = 1;
  double rest_rad_s = 0;
  double log_evidence = 0;
};

/// `windows`: all with a gyro.
GyroFit fit_gyro_model(std::span<const MotionWindow> windows, const GyroModel& model);

}  // namespace cornerd::calibration
