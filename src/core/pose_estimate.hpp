// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/geometry/pose2.hpp"
#include "core/types.hpp"

namespace cornerd::core {

enum class PoseState : std::uint8_t { kFix, kTracking, kPredicted, kAmbiguous, kLost };

/// True if the scan itself gives the pose.
constexpr bool has_pose(PoseState state) {
  return state == PoseState::kFix || state == PoseState::kTracking;
}

/// A pose hypothesis that fits the scan. The scores of a scan are posteriors; they sum to 1.
struct Alternative {
  Pose2 T_map_base;
  double score = 0;
  std::size_t map = 0;  ///< where it is in one of several, see MapChoice
};

inline constexpr std::size_t kMaxAlternatives = 16;

/// Pose of the robot at `t_ns`. In the states ambiguous and lost only `alternatives` says anything
/// about the pose.
struct PoseEstimate {
  std::uint64_t seq = 0;  ///< counts the estimates
  TimeNs t_ns = 0;
  PoseState state = PoseState::kLost;
  Pose2 T_map_base;
  Covariance3 covariance = Covariance3::Zero();
  std::optional<std::size_t> room;  ///< index into the map's rooms
  std::size_t corners = 0;          ///< recognised breakpoints
  std::size_t inliers = 0;          ///< samples on the map's walls
  double rmse_m = 0;                ///< of the inliers
  double age_s = 0;                 ///< since the last fix or tracking
  /// 1 - posterior of the likeliest hypothesis of this scan, 0 to 1 (Decision::doubt). At least
  /// kLeastDoubt where it is ambiguous; NaN of a partial scan, which compares no places.
  double p_wrong = 0;
  std::vector<Alternative> alternatives;  ///< capacity kMaxAlternatives; best first
};

}  // namespace cornerd::core
