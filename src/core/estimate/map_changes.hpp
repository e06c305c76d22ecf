// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/map/ray_caster.hpp"
#include "core/map/wall_map.hpp"
#include "core/polar_scan.hpp"
#include "core/types.hpp"

namespace cornerd::core {

/// Something that stays, and is not as the map has it.
struct MapChange {
  enum class Kind : std::uint8_t { kWallGone, kNewThing };
  Kind kind = Kind::kNewThing;
  std::uint32_t wall = 0;  ///< kWallGone: index into FloorPlan::walls
  Vec2 position = Vec2::Zero();

  bool operator==(const MapChange&) const = default;
};

/// Finds walls that rays go through, and things in front of walls, where they stay: people pass.
/// One scan a second counts. A grid over the map counts for how long each cell has been occupied; a
/// ray through it counts against. Allocates nothing after construction.
class MapChanges {
 public:
  static constexpr std::size_t kMaxChanges = 64;

  MapChanges(const WallMap& map, double max_range_m);

  /// A scan at a known pose. `sigma_m`: of the walls' offsets from the map.
  void add(const WallMap& map, const Pose2& T_map_lidar, std::span<const PolarPoint> points,
           double sigma_m, TimeNs t_ns);

  /// Goes on from changes() of an earlier run. Those that are not of this map are left out.
  void resume(std::span<const MapChange> changes);

  /// Those that are there now, in the order in which they were found.
  std::span<const MapChange> changes() const { return changes_; }

 private:
  struct WallLook {
    std::uint32_t rays = 0;
    std::uint32_t through = 0;
    std::uint32_t on_wall = 0;
  };
  std::size_t cell_at(const Vec2& point) const;
  void count_ray(const Vec2& origin, const Vec2& end, bool is_short);
  void end_look();
  void update_things();
  void report(const MapChange& change);

  RayCaster ray_caster_;
  std::vector<std::int32_t> walls_of_faces_;  ///< -1: a wall's end
  std::vector<WallLook> looks_;               ///< of this scan, by wall
  std::vector<std::uint8_t> gone_;            ///< scans through each wall in a row
  Vec2 low_;
  double cell_m_ = 0;
  std::size_t columns_ = 0;
  std::vector<std::uint8_t> occupied_;  ///< scans, by cell
  std::vector<std::uint8_t> now_;       ///< of this scan: kFree, kOccupied
  std::vector<MapChange> changes_;
  TimeNs last_ns_ = 0;
};

}  // namespace cornerd::core
