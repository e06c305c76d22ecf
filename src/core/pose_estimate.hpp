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

/// True where a turn itself says where the robot is.
constexpr bool names_a_place(PoseState state) {
  return state == PoseState::kFix || state == PoseState::kTracking;
}

/// A place that explains the turn. The scores of one turn are shares of belief: they sum to 1.
struct Alternative {
  Pose2 T_map_base;
  double score = 0;
};

inline constexpr std::size_t kMaxAlternatives = 16;

/// Where the robot was at `t_ns`, and how far to believe it. In the states ambiguous and lost
/// nothing but `alternatives` says anything about the place.
struct PoseEstimate {
  std::uint64_t seq = 0;  ///< counts the estimates
  TimeNs t_ns = 0;
  PoseState state = PoseState::kLost;
  Pose2 T_map_base;
  Covariance3 covariance = Covariance3::Zero();
  std::optional<std::size_t> room;  ///< index into the map's rooms
  std::size_t corners = 0;          ///< breakpoints that were recognised
  std::size_t inliers = 0;          ///< samples that lie on the map's walls
  double rmse_m = 0;                ///< of the inliers
  double age_s = 0;                 ///< since the last turn that named a place
  /// The turn's belief that its likeliest place is not the right one: 0 to 1, Decision::doubt.
  double doubt = 0;
  std::vector<Alternative> alternatives;  ///< capacity kMaxAlternatives; best first
};

}  // namespace cornerd::core
