// SPDX-License-Identifier: MIT
// Bertocco et al. (2019), section III: factors "by a grid-searching in possible candidates". The
// paper does not give the candidates.
#pragma once

#include <span>

#include "calibration/drive_reckoning.hpp"

namespace cornerd::calibration {

/// Range of a factor. In the weighted mean (equation 5), 0 leaves a sensor out.
inline constexpr double kMinFactor = 0;
inline constexpr double kMaxFactor = 2.5;

struct FoundFactors {
  PaperFactors factors;
  /// The best factor is at an end of the range, and may lie beyond.
  bool encoder_at_edge = false;
  bool gyro_at_edge = false;

  bool at_edge() const { return encoder_at_edge || gyro_at_edge; }
};

/// The factors with the least mean error over the known poses, to 0.001, by grids of decreasing
/// step. The dead band of `start` stays.
FoundFactors search_factors(std::span<const core::OdometryIncrement> steps,
                            std::span<const KnownPose> places, const core::DriveGeometry& geometry,
                            const DeadReckoningConfig& start);

}  // namespace cornerd::calibration
