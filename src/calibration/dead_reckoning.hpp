// SPDX-License-Identifier: MIT
// Bertocco, Oliveira, Santos: Odometry and Feature Extraction (2019), section III.
#pragma once

#include <cstdint>

#include "core/odometry/odometry_config.hpp"
#include "core/odometry/odometry_increment.hpp"

namespace cornerd::calibration {

/// Source of heading changes: the modes of Bertocco et al. (2019), and the filter.
enum class HeadingSource : std::uint8_t { kEncoder, kGyro, kMean, kWeighted, kFilter };

/// Factors of the paper's modes.
struct PaperFactors {
  double encoder_factor = 1;  ///< c_enco
  double gyro_factor = 1;     ///< c_gyro
  /// tr: smaller changes of a wheel's angle or of the heading are taken as zero; 0.01 in the paper.
  double dead_band_rad = 0;
};

struct DeadReckoningConfig {
  HeadingSource source = HeadingSource::kEncoder;  ///< one of the paper's four
  PaperFactors factors;
};

/// Heading change of an increment by the paper's modes: encoders alone, gyro alone, equation 4,
/// equation 5. Without a gyro all use the encoders.
double heading_change(const core::OdometryIncrement& step, const core::DriveGeometry& geometry,
                      const DeadReckoningConfig& config);

/// The increment with the wheels' rotations that give the heading change of that mode.
core::OdometryIncrement by_wheels_alone(const core::OdometryIncrement& step,
                                        const core::DriveGeometry& geometry,
                                        const DeadReckoningConfig& config);

/// Integrates increments from a known pose, without corrections.
class DeadReckoning {
 public:
  DeadReckoning(const core::DriveGeometry& geometry, const DeadReckoningConfig& config,
                const core::Pose2& start = {})
      : geometry_(geometry), config_(config), T_start_base_(start) {}

  const core::Pose2& add(const core::OdometryIncrement& step);
  const core::Pose2& pose() const { return T_start_base_; }

 private:
  core::DriveGeometry geometry_;
  DeadReckoningConfig config_;
  core::Pose2 T_start_base_;
};

}  // namespace cornerd::calibration
