// SPDX-License-Identifier: MIT
// Bertocco et al. (2019), section III: factors "by a grid-searching in possible candidates". Which
// candidates, the paper does not say.
#pragma once

#include <span>

#include "calibration/odometry_fit.hpp"

namespace cornerd::calibration {

/// What a factor may be. Of a weighted mean (equation 5), 0 leaves a sensor out, and 2 takes the
/// other one as it is.
inline constexpr double kMinFactor = 0;
inline constexpr double kMaxFactor = 2.5;

struct FoundFactors {
  core::PaperFactors factors;
  /// The best one stands at an end of what was searched: it may lie beyond.
  bool encoder_at_edge = false;
  bool gyro_at_edge = false;

  bool at_edge() const { return encoder_at_edge || gyro_at_edge; }
};

/// The factors of a mode for which the mean error over the known places is least, to 0.001. The
/// dead band of `start` holds throughout. A grid over all candidates, then finer ones around its
/// best, each of which follows the best until that is inside.
FoundFactors search_factors(std::span<const core::OdometryIncrement> steps,
                            std::span<const KnownPose> places, const core::DriveGeometry& geometry,
                            const core::DeadReckoningConfig& start);

}  // namespace cornerd::calibration
