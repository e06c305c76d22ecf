// SPDX-License-Identifier: MIT
#include "bench/localization/reliability.hpp"

#include "replay/pose_error.hpp"

namespace cornerd::bench {

void Reliability::add(const core::PoseEstimate& estimate, const core::Pose2& truth) {
  const bool is_fix = estimate.state == core::PoseState::kFix;
  if (!is_fix && estimate.alternatives.empty()) return;
  const core::Pose2& first =
      is_fix ? estimate.T_map_base : estimate.alternatives.front().T_map_base;
  Bin* bin = bins_.data();
  for (Bin& each : bins_) {
    if (estimate.p_wrong >= each.least_doubt) bin = &each;
  }
  ++bin->scans;
  bin->wrong += replay::is_right(first, truth) ? 0 : 1;
  bin->doubt += estimate.p_wrong;
}

void Reliability::add(const Reliability& other) {
  for (std::size_t k = 0; k < bins_.size(); ++k) {
    bins_[k].scans += other.bins_[k].scans;
    bins_[k].wrong += other.bins_[k].wrong;
    bins_[k].doubt += other.bins_[k].doubt;
  }
}

}  // namespace cornerd::bench
