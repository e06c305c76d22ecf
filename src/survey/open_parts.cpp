// SPDX-License-Identifier: MIT
#include "survey/open_parts.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace cornerd::survey {
namespace {

constexpr double kOpenCell_m = 0.05;
/// The narrowest gap that is told from a wall that was seen too rarely.
constexpr double kLeastOpen_m = 0.3;
/// Places of which as many saw through a cell that it is open; and how many are tried.
constexpr std::size_t kMinPlaces = 3;
constexpr std::size_t kMaxPlaces = 150;
/// A line of sight passes a cell where what it ends on is farther beyond it.
constexpr double kBeyond_m = 0.25;
/// A return this near shows that something is there.
constexpr double kNearReturn_m = 0.12;
/// Of an A1.
constexpr double kSight_m = 12;

}  // namespace

bool OpenSpace::is_open_at(const core::Vec2& point) const {
  const std::size_t stride = std::max<std::size_t>(1, places_.size() / kMaxPlaces);
  std::size_t through = 0;
  for (std::size_t i = 0; i < places_.size() && through < kMinPlaces; i += stride) {
    const core::Vec2 ray = point - places_[i];
    const double distance_m = ray.norm();
    if (distance_m + kBeyond_m > kSight_m) continue;
    const double range_m =
        surveyed_.range_along(places_[i], std::atan2(ray.y(), ray.x()), kSight_m);
    if (range_m > distance_m + kBeyond_m) ++through;
  }
  return through >= kMinPlaces;
}

std::vector<std::pair<double, double>> OpenSpace::parts_of(const core::Wall& wall) const {
  const double length_m = (wall.to - wall.from).norm();
  const auto count = static_cast<std::size_t>(length_m / kOpenCell_m);
  if (count == 0) return {};
  const core::Vec2 along = (wall.to - wall.from) / length_m;
  const double cell_m = length_m / static_cast<double>(count);

  std::vector<bool> is_open(count, true);
  const double near_m = kNearReturn_m + wall.thickness_m / 2;
  for (const core::Vec2& point : returns_) {
    const core::Vec2 off = point - wall.from;
    if (std::abs(along.x() * off.y() - along.y() * off.x()) > near_m) continue;
    const double cell = along.dot(off) / cell_m;
    if (cell >= 0 && cell < static_cast<double>(count)) {
      is_open[static_cast<std::size_t>(cell)] = false;
    }
  }
  std::vector<std::pair<double, double>> parts;
  std::size_t begin = 0;
  for (std::size_t i = 0; i <= count; ++i) {
    if (i < count && is_open[i]) {
      is_open[i] = is_open_at(wall.from + (static_cast<double>(i) + 0.5) * cell_m * along);
    }
    if (i < count && is_open[i]) continue;
    const double begin_m = static_cast<double>(begin) * cell_m;
    const double end_m = static_cast<double>(i) * cell_m;
    if (end_m - begin_m >= std::min(kLeastOpen_m, length_m)) parts.emplace_back(begin_m, end_m);
    begin = i + 1;
  }
  return parts;
}

}  // namespace cornerd::survey
