// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/map/sight.hpp"
#include "core/map/wall_map.hpp"
#include "core/polar_scan.hpp"

namespace cornerd::core {

/// What each ray of a turn would meet first at a given place.
struct PredictedHit {
  static constexpr std::uint32_t kNone = 0xffffffff;
  double range_m = 0;          ///< 0: no wall within reach
  std::uint32_t face = kNone;  ///< index into WallMap::faces()
};

/// Predicts all rays of a turn at once: every face that the place may see covers an interval of
/// bearings, and only the rays in it are intersected with its line. Memory is taken at
/// construction.
class RayCaster {
 public:
  explicit RayCaster(double max_range_m);

  /// `points` by rising bearing. The result is valid until the next call.
  std::span<const PredictedHit> cast(const WallMap& map, const Pose2& T_map_lidar,
                                     std::span<const PolarPoint> points);
  /// The same, but walls count only where they are not much farther off than the farthest return:
  /// what lies beyond cannot have been seen, and costs most where the place is wrong.
  std::span<const PredictedHit> cast_near(const WallMap& map, const Pose2& T_map_lidar,
                                          std::span<const PolarPoint> points);

 private:
  std::span<const PredictedHit> cast(const WallMap& map, const Pose2& T_map_lidar,
                                     std::span<const PolarPoint> points, double reach_m);
  void cover(std::uint32_t face, const Vec2& normal_lidar, double height_m, std::size_t begin,
             std::size_t end, std::span<const PolarPoint> points);

  double max_range_m_;
  Sight sight_;
  std::vector<PredictedHit> hits_;
};

}  // namespace cornerd::core
