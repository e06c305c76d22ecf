// SPDX-License-Identifier: MIT
// Compares a pose with the truth.
#pragma once

#include <optional>

#include "core/pose_estimate.hpp"

namespace cornerd::replay {

/// A pose farther from the truth is wrong.
inline constexpr double kWrong_m = 0.1;
inline constexpr double kWrong_rad = core::radians(5);

/// 95 % quantile of chi-square with 3 degrees of freedom.
inline constexpr double kNees95 = 7.815;

struct PoseError {
  double position_m = 0;
  double heading_rad = 0;  ///< absolute
};
PoseError error_of(const core::Pose2& T_map_base, const core::Pose2& truth);

bool is_right(const core::Pose2& T_map_base, const core::Pose2& truth);

/// True if the true pose is among the alternatives.
bool lists_truth(const core::PoseEstimate& estimate, const core::Pose2& truth);

/// Normalised estimation error squared (NEES), 3 on average for a consistent covariance. nullopt if
/// the covariance is not positive definite.
std::optional<double> normalised_error_squared(const core::PoseEstimate& estimate,
                                               const core::Pose2& truth);

}  // namespace cornerd::replay
