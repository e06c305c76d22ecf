// SPDX-License-Identifier: MIT
#include "survey/rejected_odometry.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

#include "core/odometry/wrapping_counter.hpp"

namespace cornerd::survey {
namespace {

/// A tracked robot that slips in every rotation: 6 % of the scans. Wrong wheel counts: 13 % or
/// more.
constexpr double kMaxRejectedShare = 0.1;

/// Shorter motions between scans are the lidar's noise.
constexpr double kMinWay_m = 0.02;

/// A jump beyond the speed limit is a restart of the controller, and is left out.
double counted_m(const RecordedDrive& drive, const core::OdometryConfig& config,
                 std::optional<std::int64_t> core::OdometryReading::*wheel) {
  const core::DriveGeometry& geometry = config.geometry;
  double distance_m = 0;
  std::optional<std::int64_t> last;
  core::TimeNs last_ns = 0;
  for (const RecordedDrive::Reading& next : drive.readings()) {
    const std::optional<std::int64_t> count = next.reading.*wheel;
    if (!count) continue;
    if (last) {
      const std::int64_t rolled = core::count_difference(*last, *count, geometry.counter_max);
      const double step_m = std::abs(static_cast<double>(rolled)) * geometry.metres_per_count();
      const double dt_s = core::to_seconds(next.reading.t_ns - last_ns);
      if (dt_s > 0 && step_m < config.limits.wheel_speed_m_s * dt_s) distance_m += step_m;
    }
    last = count;
    last_ns = next.reading.t_ns;
  }
  return distance_m;
}

}  // namespace

bool exceeds_rejection_share(std::size_t rejected, std::size_t scans) {
  return static_cast<double>(rejected) > kMaxRejectedShare * static_cast<double>(scans);
}

void measure_wheel_distances(const RecordedDrive& drive, std::span<const core::Pose2> T_map_base,
                             const core::OdometryConfig& config, RejectedOdometry& rejected) {
  rejected.left.counted_m = counted_m(drive, config, &core::OdometryReading::left);
  rejected.right.counted_m = counted_m(drive, config, &core::OdometryReading::right);
  core::Pose2 from = T_map_base.empty() ? core::Pose2() : T_map_base.front();
  for (const core::Pose2& to : T_map_base) {
    const core::Pose2 motion = from.inverse() * to;
    const double half_rotation_m = motion.theta_rad * config.geometry.track_m / 2;
    const double left_m = std::abs(motion.x_m - half_rotation_m);
    const double right_m = std::abs(motion.x_m + half_rotation_m);
    if (std::max(left_m, right_m) < kMinWay_m) continue;
    rejected.left.lidar_m += left_m;
    rejected.right.lidar_m += right_m;
    from = to;
  }
}

}  // namespace cornerd::survey
