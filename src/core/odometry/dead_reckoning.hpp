// SPDX-License-Identifier: MIT
// Bertocco, Oliveira, Santos: Odometry and Feature Extraction (2019), section III.
#pragma once

#include "core/odometry/odometry_config.hpp"
#include "core/odometry/odometry_increment.hpp"

namespace cornerd::core {

struct DeadReckoningConfig {
  HeadingSource source = HeadingSource::kEncoder;  ///< one of the paper's four
  PaperFactors factors;
};

/// The change of heading in a step, by the paper's modes: encoders alone, gyro alone, equation 4,
/// equation 5. Without a gyro all of them take the encoders.
double heading_change(const OdometryIncrement& step, const DriveGeometry& geometry,
                      const DeadReckoningConfig& config);

/// The same step as wheels without a gyro would have to tell it: the filter's way to use a mode of
/// the paper.
OdometryIncrement by_wheels_alone(const OdometryIncrement& step, const DriveGeometry& geometry,
                                  const DeadReckoningConfig& config);

/// Adds up steps from a known start. Nothing corrects it.
class DeadReckoning {
 public:
  DeadReckoning(const DriveGeometry& geometry, const DeadReckoningConfig& config,
                const Pose2& start = {})
      : geometry_(geometry), config_(config), T_start_base_(start) {}

  const Pose2& add(const OdometryIncrement& step);
  const Pose2& pose() const { return T_start_base_; }

 private:
  DriveGeometry geometry_;
  DeadReckoningConfig config_;
  Pose2 T_start_base_;
};

}  // namespace cornerd::core
