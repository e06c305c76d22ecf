// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "core/map/wall_map.hpp"

namespace cornerd::survey {

/// What a survey shows to be free: lines of sight from where the lidar was to walls beyond.
class OpenSpace {
 public:
  /// All arguments must outlive it. `returns`: points that rays ended on.
  OpenSpace(const core::WallMap& surveyed, std::span<const core::Vec2> places,
            std::span<const core::Vec2> returns)
      : surveyed_(surveyed), places_(places), returns_(returns) {}

  /// Parts of a drawn wall, in metres from its first point, ascending, that were seen through from
  /// several places and that no ray ended near.
  std::vector<std::pair<double, double>> parts_of(const core::Wall& wall) const;

 private:
  bool is_open_at(const core::Vec2& point) const;

  const core::WallMap& surveyed_;
  std::span<const core::Vec2> places_;
  std::span<const core::Vec2> returns_;
};

}  // namespace cornerd::survey
