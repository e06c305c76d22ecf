// SPDX-License-Identifier: MIT
// Bertocco, Oliveira, Santos: Odometry and Feature Extraction (2019), section III.
#pragma once

#include <cstdint>

#include "core/odometry/motion_step.hpp"
#include "core/odometry/odometry_config.hpp"

namespace cornerd::core {

/// Where a change of heading comes from. The first four are those of Bertocco et al. (2019).
enum class HeadingSource : std::uint8_t { kEncoder, kGyro, kMean, kWeighted, kFilter };

/// What the paper's modes multiply and leave out.
struct PaperFactors {
  double encoder_factor = 1;  ///< c_enco
  double gyro_factor = 1;     ///< c_gyro
  /// tr: smaller changes of a wheel's angle or of the heading count as none; the paper has 0.01.
  double dead_band_rad = 0;
};

struct DeadReckoningConfig {
  HeadingSource source = HeadingSource::kEncoder;  ///< one of the paper's four
  PaperFactors factors;
};

/// The change of heading in a step, by the paper's modes: encoders alone, gyro alone, equation 4,
/// equation 5. Without a gyro all of them take the encoders.
double heading_change(const MotionStep& step, const DriveGeometry& geometry,
                      const DeadReckoningConfig& config);

/// The same step as wheels without a gyro would have to tell it.
MotionStep by_wheels_alone(const MotionStep& step, const DriveGeometry& geometry,
                           const DeadReckoningConfig& config);

/// Adds up steps from a known start. Nothing corrects it.
class DeadReckoning {
 public:
  DeadReckoning(const DriveGeometry& geometry, const DeadReckoningConfig& config,
                const Pose2& start = {})
      : geometry_(geometry), config_(config), T_start_base_(start) {}

  const Pose2& add(const MotionStep& step);
  const Pose2& pose() const { return T_start_base_; }

 private:
  DriveGeometry geometry_;
  DeadReckoningConfig config_;
  Pose2 T_start_base_;
};

}  // namespace cornerd::core
