// SPDX-License-Identifier: MIT
// How a pose is judged against the truth, whoever counts.
#pragma once

#include <optional>

#include "core/localizer.hpp"

namespace cornerd::replay {

/// A pose farther from the truth than this is wrong, not merely inexact.
inline constexpr double kWrong_m = 0.1;
inline constexpr double kWrong_rad = core::radians(5);

/// 95 % of a chi-square of three degrees of freedom.
inline constexpr double kNees95 = 7.815;

struct PoseError {
  double place_m = 0;
  double heading_rad = 0;  ///< without its sign
};
PoseError error_of(const core::Pose2& T_map_base, const core::Pose2& truth);

bool is_right(const core::Pose2& T_map_base, const core::Pose2& truth);

/// True where the true place is among the alternatives.
bool lists_truth(const core::PoseEstimate& estimate, const core::Pose2& truth);

/// Normalised estimation error squared: 3 on average where the covariances are honest. nullopt
/// where the covariance is none.
std::optional<double> normalised_error_squared(const core::PoseEstimate& estimate,
                                               const core::Pose2& truth);

}  // namespace cornerd::replay
