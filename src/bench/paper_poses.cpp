// SPDX-License-Identifier: MIT
#include "bench/paper_poses.hpp"

#include <cmath>
#include <stdexcept>
#include <string>

#include "bench/corner_experiment.hpp"
#include "bench/paper_experiment.hpp"
#include "replay/simulator/random_poses.hpp"

namespace cornerd::bench {
namespace {

/// Inverse powers of the plastic number and of the golden ratio: steps of a low-discrepancy
/// sequence (Roberts's R2, R1).
constexpr double kPlastic = 0.7548776662466927;
constexpr double kPlasticSquared = 0.5698402909980532;
constexpr double kGolden = 0.6180339887498949;

double fraction(double value) { return value - std::floor(value); }

std::size_t room_index(const core::WallMap& map, std::string_view name) {
  const auto& rooms = map.plan().rooms;
  for (std::size_t i = 0; i < rooms.size(); ++i) {
    if (rooms[i].name == name) return i;
  }
  throw std::runtime_error("map " + map.plan().name + " has no room " + std::string(name));
}

/// The next free point of the sequence in the room; advances `step`.
core::Pose2 next_place(const core::WallMap& map, std::size_t room, std::size_t& step) {
  constexpr std::size_t kMaxTries = 100'000;
  const std::vector<core::Vec2>& polygon = map.plan().rooms[room].polygon;
  core::Vec2 low = polygon.front();
  core::Vec2 high = polygon.front();
  for (const core::Vec2& point : polygon) {
    low = low.cwiseMin(point);
    high = high.cwiseMax(point);
  }
  for (std::size_t tries = 0; tries < kMaxTries; ++tries) {
    const auto k = static_cast<double>(++step);
    const core::Vec2 share(fraction(0.5 + k * kPlastic), fraction(0.5 + k * kPlasticSquared));
    const core::Vec2 point = low + share.cwiseProduct(high - low);
    if (map.room_at(point) != room || map.is_solid(point)) continue;
    if (replay::clearance_at(map, point) < kClearance_m) continue;
    return {point.x(), point.y(), core::kTwoPi * fraction(k * kGolden) - core::kPi};
  }
  throw std::runtime_error("map " + map.plan().name + " has no free place in " +
                           map.plan().rooms[room].name);
}

}  // namespace

std::vector<PaperPose> paper_poses(std::span<const std::shared_ptr<const core::WallMap>> maps) {
  std::vector<PaperPose> poses;
  for (std::size_t location = 0; location < kPaperLocations.size(); ++location) {
    std::size_t step = 0;
    for (std::size_t i = 0; i < kPaperLocations[location].poses; ++i) {
      const std::size_t m = i % maps.size();
      const std::size_t room = room_index(*maps[m], kPaperLocations[location].room);
      poses.push_back({location, m, next_place(*maps[m], room, step)});
    }
  }
  return poses;
}

}  // namespace cornerd::bench
