// SPDX-License-Identifier: MIT
#include "survey/odometry_doubt.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

namespace cornerd::survey {
namespace {

/// A tracked robot that slips wherever it turns was contradicted in 6 % of its turns, robots whose
/// wheels lie in 13 % and more.
constexpr double kMostUnbelieved = 0.1;

/// Between turns: what lies nearer together is the lidar's noise.
constexpr double kLeastWay_m = 0.02;

/// The way of one wheel by its counts; a jump that no wheel makes is a restart of the controller.
double counted_m(const RecordedDrive& drive, const core::OdometryConfig& config,
                 std::optional<std::int64_t> core::OdometryReading::*wheel) {
  const core::DriveGeometry& geometry = config.geometry;
  const std::int64_t modulus = geometry.ceiling > 0 ? geometry.ceiling + 1 : 0;
  double way_m = 0;
  std::optional<std::int64_t> last;
  core::TimeNs last_ns = 0;
  for (const RecordedDrive::Reading& next : drive.readings()) {
    const std::optional<std::int64_t> count = next.reading.*wheel;
    if (!count) continue;
    if (last) {
      std::int64_t rolled = *count - *last;
      if (modulus > 0) {
        rolled %= modulus;
        if (rolled > modulus / 2) rolled -= modulus;
        if (rolled < -modulus / 2) rolled += modulus;
      }
      const double step_m = std::abs(static_cast<double>(rolled)) * geometry.metres_per_count();
      const double dt_s = core::to_seconds(next.reading.t_ns - last_ns);
      if (dt_s > 0 && step_m < config.limits.wheel_speed_m_s * dt_s) way_m += step_m;
    }
    last = count;
    last_ns = next.reading.t_ns;
  }
  return way_m;
}

}  // namespace

bool are_too_many(std::size_t unbelieved, std::size_t scans) {
  return static_cast<double>(unbelieved) > kMostUnbelieved * static_cast<double>(scans);
}

void measure_wheels(const RecordedDrive& drive, std::span<const core::Pose2> T_map_base,
                    const core::OdometryConfig& config, OdometryDoubt& doubt) {
  doubt.left.counted_m = counted_m(drive, config, &core::OdometryReading::left);
  doubt.right.counted_m = counted_m(drive, config, &core::OdometryReading::right);
  core::Pose2 from = T_map_base.empty() ? core::Pose2() : T_map_base.front();
  for (const core::Pose2& to : T_map_base) {
    const core::Pose2 way = from.inverse() * to;
    const double half_rotation_m = way.theta_rad * config.geometry.track_m / 2;
    const double left_m = std::abs(way.x_m - half_rotation_m);
    const double right_m = std::abs(way.x_m + half_rotation_m);
    if (std::max(left_m, right_m) < kLeastWay_m) continue;
    doubt.left.true_m += left_m;
    doubt.right.true_m += right_m;
    from = to;
  }
}

}  // namespace cornerd::survey
