// SPDX-License-Identifier: MIT
#include "replay/simulator/random_poses.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "replay/simulator/random.hpp"

namespace cornerd::replay {
namespace {

/// Rays per point; a ray that hits no wall means outside. None is along an axis or a diagonal: on
/// these lie corners, between whose faces a ray may pass.
constexpr int kDirections = 64;
constexpr double kFirstDirection_rad = 0.0382;
/// Usable share of the map's bounding box below which the search gives up.
constexpr double kMinUsableShare = 1e-4;

bool has_walls_on_all_sides(const core::WallMap& map, const core::Vec2& point) {
  const double diagonal_m = (map.upper_right() - map.lower_left()).norm();
  for (int i = 0; i < kDirections; ++i) {
    const double angle_rad = kFirstDirection_rad + core::kTwoPi * i / kDirections;
    if (map.range_along(point, angle_rad, diagonal_m) <= 0) return false;
  }
  return true;
}

}  // namespace

bool is_indoors(const core::WallMap& map, const core::Vec2& point) {
  return !map.is_solid(point) && (map.room_at(point) || has_walls_on_all_sides(map, point));
}

double clearance_at(const core::WallMap& map, const core::Vec2& point) {
  double nearest_m = std::numeric_limits<double>::infinity();
  for (const core::Face& face : map.faces()) {
    const double along_m = std::clamp((point - face.from).dot(face.direction), 0.0, face.length_m);
    nearest_m = std::min(nearest_m, (face.from + along_m * face.direction - point).norm());
  }
  return nearest_m;
}

std::vector<core::Pose2> random_poses(const core::WallMap& map, std::size_t count,
                                      double clearance_m, std::uint64_t seed) {
  Random random(seed);
  std::vector<core::Pose2> poses;
  const auto max_tries = static_cast<std::size_t>(static_cast<double>(count + 1) / kMinUsableShare);
  for (std::size_t tries = 0; poses.size() < count; ++tries) {
    if (tries == max_tries) {
      throw std::runtime_error(
          "the map has no room for a robot with that clearance; choose a smaller one");
    }
    const double x_m = random.uniform(map.lower_left().x(), map.upper_right().x());
    const double y_m = random.uniform(map.lower_left().y(), map.upper_right().y());
    const double theta_rad = random.uniform(-core::kPi, core::kPi);
    const core::Vec2 point(x_m, y_m);
    if (clearance_at(map, point) < clearance_m || !is_indoors(map, point)) continue;
    poses.push_back({x_m, y_m, theta_rad});
  }
  return poses;
}

}  // namespace cornerd::replay
