// SPDX-License-Identifier: MIT
#include "core/recognition/part_tracker.hpp"

#include "core/geometry/linear_solve.hpp"

namespace cornerd::core {
namespace {

/// What is expected may be off by this much, as a part shows it; one that says more is not
/// believed.
constexpr double kPartReach_m = 0.05;
constexpr double kMostSurprise_m = 0.15;
constexpr double kMostSurprise_rad = radians(15);
/// A part has few rays, of few walls: most of them have to be where they were expected, and hardly
/// any may go through a wall.
constexpr std::size_t kLeastHits = 25;
constexpr double kLeastHitShare = 0.8;
constexpr double kMostThroughShare = 0.05;

}  // namespace

PartTracker::PartTracker(const WallMap& map, const LocalizerConfig& config)
    : map_(map),
      min_range_m_(config.min_range_m),
      max_range_m_(config.max_range_m),
      noise_(config.noise),
      parts_(config.updates_per_scan),
      prediction_(config.max_range_m),
      refinement_(config.max_range_m, config.noise),
      stream_(config.detector, config.noise) {
  breakpoints_.reserve(kMaxBreakpointsPerScan);
}

void PartTracker::begin_scan() {
  usual_ = whole_ ? samples_ : 0;
  const Sweep sweep = swept_rad_ > 0 ? Sweep::kCounterClockwise : Sweep::kClockwise;
  if (usual_ > 0) stream_.begin(kTwoPi / static_cast<double>(usual_), sweep);
  whole_ = true;
  samples_ = 0;
  ended_ = 0;
  swept_rad_ = 0;
  part_has_ended_ = true;
}

bool PartTracker::add(const Sample& sample) {
  if (sample.starts_scan) begin_scan();
  if (part_has_ended_) {
    part_.clear();
    breakpoints_.clear();
    part_has_ended_ = false;
  }
  if (samples_++ > 0) swept_rad_ += angle_between(last_bearing_rad_, sample.bearing_rad);
  last_bearing_rad_ = sample.bearing_rad;
  if (usual_ == 0 || !part_.add(sample)) return false;
  const double range_m = sample.range_m;
  if (range_m >= min_range_m_ && range_m <= max_range_m_) {
    for (const Breakpoint& found : stream_.add(sample.bearing_rad, range_m)) {
      if (breakpoints_.size() < kMaxBreakpointsPerScan) breakpoints_.push_back(found);
    }
  }
  if (ended_ + 1 >= parts_ || samples_ < (ended_ + 1) * usual_ / parts_) return false;
  ++ended_;
  part_has_ended_ = true;
  return true;
}

std::optional<PartPose> PartTracker::localize(const Expectation& expected, const SensorBias& bias,
                                              double noise_scale) {
  points_.assign(part_, min_range_m_, max_range_m_, end_ns(), expected.motion, bias);
  const PosePrior prior{expected.T_map_lidar, inverse(expected.covariance)};
  PartPose pose;
  pose.refined = refinement_.refine(map_, expected.T_map_lidar, kPartReach_m, points_.points(),
                                    points_.points(), noise_scale, &prior);
  if (!pose.refined.valid || !same_place(pose.refined.T_map_lidar, expected.T_map_lidar,
                                         kMostSurprise_m, kMostSurprise_rad)) {
    return std::nullopt;
  }
  const auto hits = prediction_.cast(map_, pose.refined.T_map_lidar, points_.points());
  pose.explanation =
      explain(map_, points_.points(), hits, pose.refined.T_map_lidar, noise_, noise_scale, 0);
  if (pose.explanation.hits < kLeastHits || pose.explanation.hit_share() < kLeastHitShare ||
      pose.explanation.through_share() > kMostThroughShare) {
    return std::nullopt;
  }
  return pose;
}

}  // namespace cornerd::core
