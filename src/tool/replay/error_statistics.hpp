// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "core/pose_estimate.hpp"

namespace cornerd::tool {

/// Errors of poses against the truth, and the consistency (NEES) of their covariances.
class ErrorStatistics {
 public:
  void add(const core::PoseEstimate& estimate, const core::Pose2& T_map_base);
  /// A scan without a true pose.
  void add_unknown() { ++unknown_; }

  std::size_t scans() const { return scans_; }
  std::size_t count(core::PoseState state) const { return states_[index(state)]; }
  std::size_t wrong() const { return wrong_; }
  /// Ambiguous scans, one of whose alternatives is the true pose.
  std::size_t ambiguous_with_truth() const { return ambiguous_with_truth_; }
  double mean_error_m() const;
  double max_error_m() const;
  /// Normalised estimation error squared: 3 on average if the covariances are consistent.
  double mean_nees() const;

  /// Several lines for the user.
  std::string report(std::string_view counted = "scans") const;

 private:
  static constexpr std::size_t kStates = 5;
  static std::size_t index(core::PoseState state) { return static_cast<std::size_t>(state); }

  void add_pose(const core::PoseEstimate& estimate, const core::Pose2& truth);

  std::size_t scans_ = 0;
  std::size_t unknown_ = 0;
  std::array<std::size_t, kStates> states_{};
  std::size_t wrong_ = 0;
  std::size_t ambiguous_with_truth_ = 0;
  std::vector<double> distances_m_;
  std::vector<double> angles_rad_;
  double nees_sum_ = 0;
  std::size_t nees_count_ = 0;
};

}  // namespace cornerd::tool
