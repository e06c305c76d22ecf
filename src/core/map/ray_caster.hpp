// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/map/visible_faces.hpp"
#include "core/map/wall_map.hpp"
#include "core/polar_scan.hpp"

namespace cornerd::core {

/// The face that a ray hits first from a given pose.
struct PredictedHit {
  static constexpr std::uint32_t kNone = 0xffffffff;
  double range_m = 0;          ///< 0: no wall within range
  std::uint32_t face = kNone;  ///< index into WallMap::faces()
  float sine = 0;              ///< of the angle between the ray and the face
};

/// Ray casting for a whole scan: every visible face covers an interval of bearings, and only the
/// rays in it are intersected with its line. Allocates nothing after construction.
class RayCaster {
 public:
  explicit RayCaster(double max_range_m);

  /// `points` in ascending order of bearing. The result is valid until the next call.
  std::span<const PredictedHit> cast(const WallMap& map, const Pose2& T_map_lidar,
                                     std::span<const PolarPoint> points);
  /// The same with walls only up to a metre beyond the farthest return: farther walls cannot have
  /// been seen, and cost most where the pose is wrong.
  std::span<const PredictedHit> cast_near(const WallMap& map, const Pose2& T_map_lidar,
                                          std::span<const PolarPoint> points);
  /// The same from a pose near the last cast's, with the faces that were visible there.
  std::span<const PredictedHit> cast_again(const WallMap& map, const Pose2& T_map_lidar,
                                           std::span<const PolarPoint> points);

 private:
  /// The lidar's axes in the map.
  struct Axes {
    explicit Axes(const Pose2& T_map_lidar);
    Vec2 to_lidar(const Vec2& v) const { return {c * v.x() + s * v.y(), c * v.y() - s * v.x()}; }
    double c;
    double s;
  };
  void begin(std::size_t points, double max_range_m);
  void meet(std::uint32_t face, const WallMap& map, const VisibleFace& visible, const Axes& axes,
            std::span<const PolarPoint> points);
  std::span<const PredictedHit> end();

  std::span<const PredictedHit> cast(const WallMap& map, const Pose2& T_map_lidar,
                                     std::span<const PolarPoint> points, double max_range_m);

  double max_range_m_;
  VisibleFaces visible_faces_;
  std::vector<PredictedHit> hits_;
  double last_max_range_m_ = 0;
  std::vector<std::uint32_t> visible_;  ///< of the last cast, at most kMaxVisible
};

}  // namespace cornerd::core
