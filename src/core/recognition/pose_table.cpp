// SPDX-License-Identifier: MIT
#include "core/recognition/pose_table.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace cornerd::core {
namespace {

constexpr double kCell_m = 0.08;
constexpr double kCell_rad = kTwoPi / 48;

std::uint64_t cell_of(const Pose2& pose) {
  // 24 bits: 1,300 km.
  const auto x = static_cast<std::int64_t>(std::floor(pose.x_m / kCell_m)) & 0xffffff;
  const auto y = static_cast<std::int64_t>(std::floor(pose.y_m / kCell_m)) & 0xffffff;
  const auto theta = static_cast<std::int64_t>(std::floor(pose.theta_rad / kCell_rad)) & 0xffff;
  return static_cast<std::uint64_t>(x) << 40 | static_cast<std::uint64_t>(y) << 16 |
         static_cast<std::uint64_t>(theta);
}

}  // namespace

PoseTable::PoseTable(std::size_t capacity)
    : capacity_(std::min<std::size_t>(capacity, 0xfffe)), slots_(std::bit_ceil(2 * capacity_)) {
  poses_.reserve(capacity_);
  keys_.reserve(capacity_);
}

void PoseTable::clear() {
  poses_.clear();
  keys_.clear();
  std::fill(slots_.begin(), slots_.end(), std::uint16_t{0});
}

void PoseTable::add(const Pose2& T_map_lidar) {
  const std::uint64_t key = cell_of(T_map_lidar);
  const std::size_t mask = slots_.size() - 1;
  // Fibonacci hashing (Knuth, volume 3, section 6.4).
  std::size_t slot = static_cast<std::size_t>(key * 0x9e3779b97f4a7c15U >> 32) & mask;
  for (; slots_[slot] != 0; slot = (slot + 1) & mask) {
    if (keys_[slots_[slot] - 1U] != key) continue;
    ++poses_[slots_[slot] - 1U].votes;
    return;
  }
  if (poses_.size() == capacity_) return;
  poses_.push_back({T_map_lidar, 1});
  keys_.push_back(key);
  slots_[slot] = static_cast<std::uint16_t>(poses_.size());
}

std::span<PoseHypothesis> PoseTable::most_voted(std::size_t count) {
  if (poses_.size() > count) {
    std::nth_element(poses_.begin(), poses_.begin() + static_cast<std::ptrdiff_t>(count),
                     poses_.end(), is_better);
  }
  return std::span(poses_).first(std::min(count, poses_.size()));
}

}  // namespace cornerd::core
