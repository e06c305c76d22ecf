// SPDX-License-Identifier: MIT
#include "survey/scan_reader.hpp"

#include <algorithm>
#include <cmath>

#include "core/estimate/constant_velocity_model.hpp"

namespace cornerd::survey {
namespace {

/// Sigma of the constant-velocity model over one scan (a seventh of a second).
constexpr double kUnknownMotion_m = 0.05;
constexpr double kUnknownMotion_rad = core::radians(6);
/// Sigma floor of a prediction by odometry.
constexpr double kOdometryFloor_m = 0.002;
constexpr double kOdometryFloor_rad = core::radians(0.1);
/// Sigma as a share of the motion: wheels, and tracks above all, slip where they turn.
constexpr double kTranslationShare = 0.05;
constexpr double kGyroRotationShare = 0.03;
constexpr double kWheelRotationShare = 0.2;

/// A gap in the scans of this length leaves the robot time to go elsewhere.
constexpr core::TimeNs kPause_ns = core::kNsPerSecond * 3 / 4;

core::OdometryConfig config_of_odometer(core::OdometryConfig config, bool has_readings,
                                        const std::optional<core::OdometryParameters>& learned) {
  constexpr double kAlways_s = 1e9;
  config.enabled = has_readings;
  config.max_extrapolation_s = kAlways_s;
  // Poses in a growing map are too uncertain to estimate the readings' delay from.
  config.noise.delay_s = config.noise.delay_s_per_sqrt_s = 0;
  config.conservative = false;
  if (learned) config.initial = *learned;
  return config;
}

core::Covariance3 diagonal(double place_m, double heading_rad) {
  return Eigen::Vector3d(place_m * place_m, place_m * place_m, heading_rad * heading_rad)
      .asDiagonal();
}

}  // namespace

ScanReader::ScanReader(const RecordedDrive& drive, const core::LocalizerConfig& config,
                       const std::optional<core::OdometryParameters>& learned,
                       std::span<const core::Pose2> earlier_poses,
                       std::span<const std::size_t> unmatched)
    : drive_(drive),
      config_(config),
      T_lidar_base_(config.T_base_lidar.inverse()),
      earlier_poses_(earlier_poses),
      unmatched_(unmatched),
      odometer_(config_of_odometer(config.odometry, drive.has_wheels(), learned)) {}

bool ScanReader::next() {
  if (started_) ++index_;
  if (index_ >= drive_.size()) return false;
  add_readings();
  drive_.load(index_, scan_);
  const core::TimeNs t_ns = drive_.middle_ns(index_);
  odometer_.advance(drive_.start_ns(index_), t_ns, drive_.end_ns(index_));
  predict(t_ns);
  if (odometer_.deskew(scan_, config_.T_base_lidar, still_)) {
    points_.assign(still_, config_.min_range_m, config_.max_range_m, t_ns, {}, config_.bias);
  } else {
    deskew(expected_motion());
  }
  started_ = true;
  return true;
}

void ScanReader::add_readings() {
  // Up to the first reading after the scan's end, so that no motion is extrapolated.
  constexpr std::size_t kScansAhead = 2;
  const core::TimeNs end_ns = drive_.end_ns(index_);
  const auto readings = drive_.readings();
  for (; next_reading_ < readings.size(); ++next_reading_) {
    const RecordedDrive::Reading& next = readings[next_reading_];
    const bool ahead = last_reading_ns_ < end_ns && next.scan <= index_ + kScansAhead;
    if (next.scan > index_ && !ahead) return;
    has_gyro_ |= next.reading.gyro_rad_s.has_value();
    odometer_.add(next.reading);
    last_reading_ns_ = next.reading.t_ns;
  }
}

void ScanReader::predict(core::TimeNs t_ns) {
  prior_ = {};
  if (!started_) {
    // The first scan defines the map frame.
    prior_.T_map_lidar = config_.T_base_lidar;
    prior_.covariance = diagonal(1e-6, 1e-7);
    return;
  }
  prior_.after_pause = is_after_pause();
  gaps_ = counters().gaps;
  const auto predicted = odometer_.prediction();
  if (predicted && !prior_.after_pause) {
    prior_.T_map_lidar = predicted->T_map_base * config_.T_base_lidar;
    prior_.T_before_now = filtered_T_map_lidar_.inverse() * prior_.T_map_lidar;
    const double rotation_share = has_gyro_ ? kGyroRotationShare : kWheelRotationShare;
    prior_.sigma_m =
        kOdometryFloor_m + kTranslationShare * prior_.T_before_now.translation().norm();
    prior_.sigma_rad =
        kOdometryFloor_rad + rotation_share * std::abs(prior_.T_before_now.theta_rad);
    prior_.covariance = predicted->covariance + diagonal(prior_.sigma_m, prior_.sigma_rad);
    prior_.by_odometry = true;
    return;
  }
  const double dt_s = core::to_seconds(t_ns - last_ns_);
  prior_.T_before_now = is_known(last_scan_) && is_known(index_)
                            ? earlier_poses_[last_scan_].inverse() * earlier_poses_[index_]
                            : last_motion_.over(std::clamp(dt_s, 0.0, 1.0));
  prior_.T_map_lidar = last_T_map_lidar_ * prior_.T_before_now;
  // The speed's change grows with time.
  const double grown = std::clamp(dt_s / 0.15, 1.0, 10.0);
  prior_.sigma_m = kUnknownMotion_m * grown;
  prior_.sigma_rad = kUnknownMotion_rad * grown;
  prior_.covariance = diagonal(prior_.sigma_m, prior_.sigma_rad);
}

bool ScanReader::is_after_pause() const {
  if (drive_.start_ns(index_) - drive_.end_ns(index_ - 1) < kPause_ns) return false;
  return !odometer_.prediction() || counters().gaps > gaps_;
}

bool ScanReader::is_contradicted() const {
  const core::OdometrySummary summary = odometer_.summary();
  return summary.present && !summary.healthy;
}

/// In the earlier pass.
bool ScanReader::is_known(std::size_t scan) const {
  return scan < earlier_poses_.size() &&
         !std::binary_search(unmatched_.begin(), unmatched_.end(), scan);
}

core::Twist2 ScanReader::expected_motion() const {
  const auto known = earlier_poses_;
  if (known.size() < 2) return last_motion_;
  const std::size_t before = index_ > 0 ? index_ - 1 : 0;
  const std::size_t after = std::min(index_ + 1, known.size() - 1);
  if (!is_known(before) || !is_known(after)) return last_motion_;
  const double dt_s = core::to_seconds(drive_.middle_ns(after) - drive_.middle_ns(before));
  if (!(dt_s > 0) || dt_s > 1) return last_motion_;
  return core::motion_between(known[before], known[after], dt_s);
}

bool ScanReader::deskew_again(const core::Pose2& T_map_lidar) {
  if (index_ == 0 || drive_.has_wheels() || is_known(index_)) return false;
  deskew(motion_to(T_map_lidar));
  return true;
}

/// Mean velocity since the last scan with a pose; zero after a pause.
core::Twist2 ScanReader::motion_to(const core::Pose2& T_map_lidar) const {
  const double dt_s = core::to_seconds(drive_.middle_ns(index_) - last_ns_);
  if (index_ == 0 || !(dt_s > 0 && dt_s < 1)) return {};
  return core::motion_between(last_T_map_lidar_, T_map_lidar, dt_s);
}

void ScanReader::deskew(const core::Twist2& motion) {
  points_.assign(scan_, config_.min_range_m, config_.max_range_m, drive_.middle_ns(index_), motion,
                 config_.bias);
}

void ScanReader::place(const core::Pose2& T_map_lidar, const core::Covariance3& covariance) {
  const core::TimeNs t_ns = drive_.middle_ns(index_);
  last_motion_ = motion_to(T_map_lidar);
  last_ns_ = t_ns;
  last_scan_ = index_;
  last_T_map_lidar_ = T_map_lidar;
  const core::Pose2 T_map_base = T_map_lidar * T_lidar_base_;
  odometer_.correct(T_map_base, core::covariance_of_base(covariance, T_map_lidar, T_map_base));
  const auto filtered = odometer_.prediction();
  filtered_T_map_lidar_ = filtered ? filtered->T_map_base * config_.T_base_lidar : T_map_lidar;
}

}  // namespace cornerd::survey
