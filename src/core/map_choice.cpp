// SPDX-License-Identifier: MIT
#include "core/map_choice.hpp"

#include <algorithm>

namespace cornerd::core {
namespace {

/// Of one scan in one map: a whole search. A scan that is looked at as if the robot had moved
/// otherwise begins another whenever one ends.
constexpr std::size_t kMostSteps = kWholeSearch / kSearchInRealTime;

MapEvidence evidence_of(Localizer& localizer, const PoseEstimate& pose) {
  MapEvidence evidence;
  evidence.log_odds = localizer.log_odds_of_map();
  if (!evidence.log_odds) return evidence;
  if (has_pose(pose.state)) evidence.places[evidence.count++] = pose.T_map_base;
  for (const Alternative& other : pose.alternatives) {
    evidence.places[evidence.count++] = other.T_map_base;
  }
  return evidence;
}

}  // namespace

MapChoice::MapChoice(std::span<const std::shared_ptr<const WallMap>> maps,
                     const LocalizerConfig& config)
    : filter_(maps.size()), evidence_(maps.size()), compared_(maps.size()) {
  localizers_.reserve(maps.size());
  for (const auto& map : maps) localizers_.emplace_back(map, config);
  bias_ = localizers_.front().estimated_bias();
  if (maps.size() == 1) {
    map_ = 0;
  } else {
    without_map_.emplace(nullptr, config);
  }
}

const ScanResult& MapChoice::step(const Scan& scan) {
  if (!map_) compare(scan);
  if (map_) return localizers_[*map_].step(scan);
  result_ = without_map_->step(scan);
  result_.bias = bias_;
  report(result_.pose);
  return result_;
}

void MapChoice::compare(const Scan& scan) {
  if (is_comparing_ && next_ == localizers_.size()) {
    is_comparing_ = false;
    filter_.update(evidence_);
    compared_ = evidence_;
    compared_ns_ = kept_.start_ns() + (kept_.end_ns() - kept_.start_ns()) / 2;
    map_ = filter_.map();
    if (map_) return localizers_[*map_].resume_odometry(*without_map_);
  }
  if (!is_comparing_) {
    is_comparing_ = true;
    steps_ = 0;
    next_ = 0;
    kept_ = scan;
  }
  while (next_ < localizers_.size() && filter_.is_ruled_out(next_)) evidence_[next_++] = {};
  if (next_ == localizers_.size()) return;
  Localizer& localizer = localizers_[next_];
  // From nothing, so that what a scan taught in a wrong map is forgotten.
  if (steps_++ == 0) {
    localizer.forget();
    localizer.resume(bias_);
  }
  const PoseEstimate& pose = localizer.step(kept_).pose;
  if (pose.state != PoseState::kFix && localizer.is_searching() && steps_ < kMostSteps) return;
  steps_ = 0;
  evidence_[next_++] = evidence_of(localizer, pose);
}

void MapChoice::report(PoseEstimate& pose) const {
  pose.p_wrong = 1;
  double sum = 0;
  for (const std::size_t map : filter_.in_doubt()) {
    if (compared_[map].count == 0) continue;
    pose.alternatives.push_back({compared_[map].places.front(), filter_.belief(map), map});
    sum += filter_.belief(map);
  }
  if (pose.alternatives.empty()) return;
  for (Alternative& alternative : pose.alternatives) alternative.score /= sum;
  pose.state = PoseState::kAmbiguous;
  pose.t_ns = compared_ns_;
  pose.p_wrong = std::max(kLeastDoubt, 1 - filter_.belief(pose.alternatives.front().map));
}

void MapChoice::resume(const EstimatedBias& learned) {
  bias_ = learned;
  for (Localizer& localizer : localizers_) localizer.resume(learned);
}

void MapChoice::resume_odometry(MapChoice& other) {
  localizer().resume_odometry(other.localizer());
}

void MapChoice::relocalize() {
  if (map_) bias_ = localizer().estimated_bias();
  if (map_ && without_map_) without_map_->resume_odometry(localizer());
  for (Localizer& localizer : localizers_) localizer.relocalize();
  if (!without_map_) return;
  without_map_->relocalize();
  map_.reset();
  filter_.forget();
  is_comparing_ = false;
  std::fill(compared_.begin(), compared_.end(), MapEvidence{});
}

void MapChoice::forget_lidar() {
  for (Localizer& localizer : localizers_) localizer.forget_lidar();
  bias_ = localizers_.front().estimated_bias();
}

}  // namespace cornerd::core
