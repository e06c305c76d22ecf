// SPDX-License-Identifier: MIT
#include "core/recognition/partial_scan_tracker.hpp"

#include <Eigen/Core>

#include "core/geometry/linear_solve.hpp"
#include "core/recognition/hypothesis.hpp"

namespace cornerd::core {
namespace {

/// Error of the prediction that the match corrects. A result farther off than the innovation limits
/// is rejected.
constexpr double kSearchRadius_m = 0.05;
constexpr double kMaxInnovation_m = 0.15;
constexpr double kMaxInnovation_rad = radians(15);
/// A partial scan has few rays on few walls: most must hit the predicted walls, and hardly any may
/// pass through one.
constexpr std::size_t kMinHits = 25;
constexpr double kMinPartialHitShare = 0.8;
constexpr double kMaxViolationShare = 0.05;

}  // namespace

PartialScanTracker::PartialScanTracker(const WallMap& map, const LocalizerConfig& config)
    : map_(map),
      min_range_m_(config.min_range_m),
      max_range_m_(config.max_range_m),
      parts_(config.updates_per_scan),
      ray_caster_(config.max_range_m),
      refinement_(config.max_range_m, config.noise),
      beam_model_(map, config.noise),
      stream_(config.detector, config.noise) {
  breakpoints_.reserve(kMaxBreakpointsPerScan);
}

void PartialScanTracker::begin_scan() {
  expected_samples_ = has_start_ ? samples_ : 0;
  const Sweep sweep = swept_rad_ > 0 ? Sweep::kCounterClockwise : Sweep::kClockwise;
  if (expected_samples_ > 0) stream_.begin(kTwoPi / static_cast<double>(expected_samples_), sweep);
  has_start_ = true;
  samples_ = 0;
  completed_parts_ = 0;
  swept_rad_ = 0;
  part_has_ended_ = true;
}

bool PartialScanTracker::add(const Sample& sample) {
  if (sample.starts_scan) begin_scan();
  if (part_has_ended_) {
    part_.clear();
    breakpoints_.clear();
    part_has_ended_ = false;
  }
  if (samples_++ > 0) swept_rad_ += angle_between(last_bearing_rad_, sample.bearing_rad);
  last_bearing_rad_ = sample.bearing_rad;
  if (expected_samples_ == 0 || !part_.add(sample)) return false;
  const double range_m = sample.range_m;
  if (range_m >= min_range_m_ && range_m <= max_range_m_) {
    for (const Breakpoint& found : stream_.add(sample.bearing_rad, range_m)) {
      if (breakpoints_.size() < kMaxBreakpointsPerScan) breakpoints_.push_back(found);
    }
  }
  if (completed_parts_ + 1 >= parts_ ||
      samples_ < (completed_parts_ + 1) * expected_samples_ / parts_)
    return false;
  ++completed_parts_;
  part_has_ended_ = true;
  return true;
}

std::optional<PartialScanPose> PartialScanTracker::localize(const PredictedState& predicted,
                                                            const SensorBias& bias,
                                                            double noise_scale) {
  points_.assign(part_, min_range_m_, max_range_m_, end_ns(), predicted.motion, bias);
  const PosePrior prior{predicted.T_map_lidar, inverse(predicted.covariance)};
  PartialScanPose pose;
  pose.refined = refinement_.refine(map_, predicted.T_map_lidar, kSearchRadius_m, points_.points(),
                                    points_.points(), noise_scale, 0, &prior);
  if (!pose.refined.valid || !same_pose(pose.refined.T_map_lidar, predicted.T_map_lidar,
                                        kMaxInnovation_m, kMaxInnovation_rad)) {
    return std::nullopt;
  }
  beam_model_.meet(
      points_.points(), ray_caster_.cast(map_, pose.refined.T_map_lidar, points_.points()),
      pose.refined.T_map_lidar, kTwoPi / static_cast<double>(expected_samples_), noise_scale);
  pose.rays = beam_model_.counts();
  if (pose.rays.hits < kMinHits || pose.rays.hit_share() < kMinPartialHitShare ||
      pose.rays.violation_share() > kMaxViolationShare) {
    return std::nullopt;
  }
  return pose;
}

}  // namespace cornerd::core
