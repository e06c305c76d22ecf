// SPDX-License-Identifier: MIT
#include "bench/localization/circle.hpp"

#include <cmath>
#include <stdexcept>

#include "replay/simulator/random_poses.hpp"

namespace cornerd::bench {
namespace {

constexpr double kCircleClearance_m = 0.15;
constexpr std::size_t kPlacesAtOnce = 16;
constexpr std::size_t kMostCircleTries = 500;

bool is_clear(const core::WallMap& world, const core::Vec2& centre, double radius_m) {
  // So near each other that no wall slips through between two of them.
  const int points = static_cast<int>(std::ceil(core::kTwoPi * radius_m / kCircleClearance_m)) + 1;
  for (int i = 0; i < points; ++i) {
    const double angle_rad = core::kTwoPi * i / points;
    const core::Vec2 point = centre + radius_m * core::unit_vector(angle_rad);
    if (world.is_solid(point)) return false;
    if (replay::clearance_at(world, point) < kCircleClearance_m) return false;
  }
  return true;
}

}  // namespace

replay::Motion circling(const core::Pose2& start, const CircularMotion& motion) {
  if (motion.yaw_rate_rad_s == 0) return replay::stand_still(start);
  return [start, motion](core::TimeNs t_ns, std::int64_t) {
    const double rotated_rad = motion.yaw_rate_rad_s * static_cast<double>(t_ns) * 1e-9;
    const double radius_m = motion.speed_m_s / motion.yaw_rate_rad_s;
    return start * core::Pose2{radius_m * std::sin(rotated_rad),
                               radius_m * (1 - std::cos(rotated_rad)),
                               core::normalize_angle(rotated_rad)};
  };
}

std::vector<core::Pose2> random_circles(const core::WallMap& world, const CircularMotion& motion,
                                        std::size_t count, std::uint64_t seed) {
  if (motion.yaw_rate_rad_s == 0) {
    return replay::random_poses(world, count, kCircleClearance_m, seed);
  }
  std::vector<core::Pose2> starts;
  const double radius_m = motion.speed_m_s / motion.yaw_rate_rad_s;
  for (std::size_t tries = 0; starts.size() < count; ++tries) {
    if (tries == kMostCircleTries) throw std::runtime_error("no room for a circle of that size");
    for (const core::Pose2& place :
         replay::random_poses(world, kPlacesAtOnce, kCircleClearance_m, seed + tries)) {
      if (starts.size() == count) break;
      if (is_clear(world, place * core::Vec2(0, radius_m), radius_m)) starts.push_back(place);
    }
  }
  return starts;
}

}  // namespace cornerd::bench
