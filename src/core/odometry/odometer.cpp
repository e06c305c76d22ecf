// SPDX-License-Identifier: MIT
#include "core/odometry/odometer.hpp"

#include <algorithm>
#include <cmath>

#include "core/geometry/squared.hpp"

namespace cornerd::core {
namespace {

/// A robot that is slower stands, or might as well: its gyro's noise is no motion.
constexpr double kLeastSpeed_m_s = 0.03;
constexpr double kLeastRate_rad_s = 0.1;
/// A prediction that is less certain than this helps nobody to find the place again.
constexpr double kMostSigma_m = 0.3;
constexpr double kMostSigma_rad = radians(15);
/// Readings that are missing for longer may have had something to tell, and a delay that is less
/// certain moves a scan.
constexpr double kPause_s = 0.04;
constexpr double kUnknownDelay_s = 0.02;

}  // namespace

Odometer::Odometer(const OdometryConfig& config)
    : config_(config),
      gate_(config),
      filter_(config),
      trust_(config.geometry),
      left_(config.geometry.metres_per_count()),
      right_(config.geometry.metres_per_count()) {}

bool Odometer::add(const OdometryReading& reading) {
  last_motion_.reset();
  if (!config_.enabled) return false;
  std::optional<OdometryIncrement> step = gate_.add(reading);
  if (!step) return false;
  last_motion_.emplace().to_ns = step->to_ns;
  if (step->to_ns < step->from_ns) {
    restart(*step);
    return false;
  }
  if (step->is_gap) {
    path_.clear();
  } else {
    const CalibratedIncrement calibrated(trusted(interpolated(*step)), config_.geometry,
                                         filter_.parameters());
    path_.add(step->from_ns, step->to_ns, calibrated.motion());
    last_motion_ = {step->to_ns, calibrated.duration_s, calibrated.motion(), calibrated.travel_m,
                    calibrated.rotation_rad};
  }
  if (size_ == kPending) {
    consume_front();
  }
  pending_[(first_ + size_++) % kPending] = *step;
  return true;
}

/// What waits is of times that never were, and how far the robot went meanwhile nobody knows.
void Odometer::restart(const OdometryIncrement& gap) {
  path_.clear();
  trust_.interrupt();
  first_ = size_ = 0;
  reached_ns_ = gap.to_ns;
  has_pose_ = false;
  filter_.doubt_times();
}

OdometryIncrement Odometer::trusted(OdometryIncrement step) const {
  step.has_gyro = step.has_gyro && (!config_.conservative || trust_.uses_gyro());
  return step;
}

OdometryIncrement Odometer::interpolated(OdometryIncrement step) {
  step.left_m = left_.travel_m(step.left_m, step.duration_s());
  step.right_m = right_.travel_m(step.right_m, step.duration_s());
  return step;
}

void Odometer::consume_front(std::optional<TimeNs> until_ns) {
  OdometryIncrement& front = pending_[first_];
  const bool splits = until_ns && *until_ns < front.to_ns;
  const OdometryIncrement step = splits ? front.split(*until_ns) : front;
  trust_.add(step, filter_);
  filter_.add(trusted(step));
  reached_ns_ = step.to_ns;
  if (splits) return;
  first_ = (first_ + 1) % kPending;
  --size_;
}

MotionFilter::Epoch Odometer::epoch_at(TimeNs reading_ns, TimeNs reached_ns) const {
  const Twist2 velocity = path_.velocity_at(reading_ns);
  const bool drives = std::abs(velocity.vx_m_s) > kLeastSpeed_m_s ||
                      std::abs(velocity.omega_rad_s) > kLeastRate_rad_s;
  return {.lead_s = to_seconds(reading_ns - reached_ns), .velocity = drives ? velocity : Twist2{}};
}

void Odometer::advance(TimeNs start_ns, TimeNs middle_ns, TimeNs end_ns) {
  start_ns_ = start_ns;
  middle_ns_ = middle_ns;
  end_ns_ = end_ns;
  if (!config_.enabled) return;
  delay_ns_ = from_seconds(filter_.parameters().delay_s);
  const TimeNs reading_ns = middle_ns + delay_ns_;
  while (size_ > 0 && pending(0).from_ns < reading_ns) consume_front(reading_ns);
  filter_.advance();
  trust_.add_comparison(filter_.take_comparison());
  epoch_ = epoch_at(reading_ns, reached_ns_);
  knows_motion_ = is_believed() && path_.covers(start_ns + delay_ns_, end_ns + delay_ns_);
  epoch_.is_deskewed = knows_motion_;
  if (knows_motion_) deskew_covariance_ = covariance_of_motion(/*slip_share=*/0);
  const TimeNs behind_ns = reading_ns - reached_ns_;
  present_ = reached_ns_ != 0 && std::abs(behind_ns) <= MotionPath::kLongestGuess_ns;
  if (!present_) has_pose_ = false;
}

std::optional<PredictedPose> Odometer::dead_reckoning() const {
  return prediction_of(filter_, epoch_, middle_ns_);
}

std::optional<PredictedPose> Odometer::prediction() const { return in_time(dead_reckoning()); }

std::optional<PredictedPose> Odometer::in_time(const std::optional<PredictedPose>& pose) const {
  const bool is_old = pose && to_seconds(pose->t_ns - fixed_ns_) > config_.max_extrapolation_s;
  return is_old ? std::nullopt : pose;
}

std::optional<PredictedPose> Odometer::predict_latest() const {
  if (size_ == 0) return std::nullopt;
  const TimeNs reading_ns = pending(size_ - 1).to_ns;
  const TimeNs t_ns = reading_ns - from_seconds(filter_.parameters().delay_s);
  if (t_ns <= middle_ns_) return std::nullopt;
  MotionFilter ahead = filter_;
  for (std::size_t i = 0; i < size_; ++i) ahead.add(trusted(pending(i)));
  ahead.advance();
  return in_time(prediction_of(ahead, epoch_at(reading_ns, reading_ns), t_ns));
}

std::optional<PredictedPose> Odometer::prediction_of(const MotionFilter& filter,
                                                     const MotionFilter::Epoch& epoch,
                                                     TimeNs t_ns) const {
  if (!has_pose_ || !present_ || !is_believed()) return std::nullopt;
  if (config_.conservative && (rejected_in_a_row_ > 0 || !trust_.carries())) return std::nullopt;
  const Covariance3 covariance = filter.covariance_at(epoch);
  const double place_m2 = std::max(covariance(0, 0), covariance(1, 1));
  if (!(place_m2 < squared(kMostSigma_m)) || !(covariance(2, 2) < squared(kMostSigma_rad))) {
    return std::nullopt;
  }
  return PredictedPose{t_ns, filter.pose_at(epoch), covariance};
}

void Odometer::correct(const Pose2& T_map_base, const Covariance3& covariance) {
  if (!config_.enabled || !present_) return;
  trust_.add_fix(T_map_base, covariance, filter_);
  const bool is_comparable = has_pose_ && !pose_is_given_;
  if (is_comparable && filter_.correct(T_map_base, covariance, epoch_)) {
    ++fixes_;
    rejected_in_a_row_ = 0;
  } else {
    if (is_comparable) {
      ++rejected_fixes_;
      filter_.doubt_times();
      ++rejected_in_a_row_;
    }
    filter_.set_pose(T_map_base, covariance, epoch_);
  }
  has_pose_ = true;
  pose_is_given_ = false;
  fixed_ns_ = middle_ns_;
}

void Odometer::set_pose(const Pose2& T_map_base, const Covariance3& covariance) {
  filter_.set_pose(T_map_base, covariance, epoch_);
  trust_.interrupt();
  rejected_in_a_row_ = 0;
  has_pose_ = true;
  pose_is_given_ = true;
  fixed_ns_ = middle_ns_;
}

void Odometer::forget() {
  has_pose_ = false;
  rejected_in_a_row_ = 0;
  trust_.interrupt();
}

void Odometer::reset() {
  const Odometer before = *this;
  *this = Odometer(config_);
  gate_ = before.gate_;
  left_ = before.left_;
  right_ = before.right_;
}

void Odometer::resume(const Odometer& other) {
  if (!config_.is_of_same_robot(other.config_)) return;
  const OdometryConfig own = config_;
  *this = other;
  config_ = own;
  forget();
}

bool Odometer::may_miss_motion() const {
  return epoch_.lead_s > kPause_s || filter_.sigma().delay_s > kUnknownDelay_s;
}

OdometrySummary Odometer::summary() const {
  OdometrySummary summary;
  summary.enabled = config_.enabled;
  summary.present = present_;
  summary.healthy = present_ && is_believed();
  summary.parameters = filter_.parameters();
  summary.sigma = filter_.sigma();
  summary.counters = gate_.counters();
  summary.slips = filter_.slips();
  summary.fixes = fixes_;
  summary.rejected_fixes = rejected_fixes_;
  return summary;
}

}  // namespace cornerd::core
