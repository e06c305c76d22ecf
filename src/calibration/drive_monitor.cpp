// SPDX-License-Identifier: MIT
#include "calibration/drive_monitor.hpp"

namespace cornerd::calibration {
namespace {

/// A minute of driving, so that a repair shows within one.
constexpr std::size_t kMonitored = 60;
/// Less tells of nothing; an evaluation takes 1 ms on a PC, and some ten on a BeagleBone.
constexpr std::size_t kMinMonitored = 8;
constexpr std::size_t kNewMonitored = 4;
/// Exceeds the factor of any wrong unit.
constexpr double kLimitFactor = 100;
/// Of a gyro in any unit.
constexpr double kMostRate = 1e6;
/// Times of readings that are further from the newest pose: the program that sends them has ended,
/// or has another clock, and OdometryInputMonitor says so.
constexpr core::TimeNs kMaxApart_ns = 2 * core::kNsPerSecond;

core::OdometryConfig of_gate(const core::OdometryConfig& config) {
  core::OdometryConfig wide = with_wide_limits(config);
  wide.conservative = false;
  return wide;
}

}  // namespace

core::OdometryConfig with_wide_limits(core::OdometryConfig config) {
  config.limits.wheel_speed_m_s *= kLimitFactor;
  config.limits.gyro_rad_s = kMostRate;
  return config;
}

DriveMonitor::DriveMonitor(const core::OdometryConfig& config, const core::Pose2& T_base_lidar)
    : config_(config), T_base_lidar_(T_base_lidar), gate_(of_gate(config)), windows_(kMonitored) {}

void DriveMonitor::add(const core::OdometryReading& reading) {
  newest_ns_ = reading.t_ns;
  if (const auto step = gate_.add(reading)) windows_.add(*step);
}

void DriveMonitor::add(core::TimeNs t_ns, const core::Pose2& T_map_base) {
  if (t_ns > newest_ns_ + kMaxApart_ns || t_ns < newest_ns_ - kMaxApart_ns) {
    windows_.clear();
    faults_ = {};
    evaluated_ = windows_.count();
  }
  windows_.add(t_ns, T_map_base * T_base_lidar_);
}

const DriveFaults& DriveMonitor::faults() {
  const std::size_t count = windows_.count();
  if (windows_.windows().size() >= kMinMonitored && count >= evaluated_ + kNewMonitored) {
    evaluated_ = count;
    const std::vector<MotionWindow> windows(windows_.windows().begin(), windows_.windows().end());
    faults_ = find_drive_faults(windows, T_base_lidar_, config_.geometry);
  }
  return faults_;
}

}  // namespace cornerd::calibration
