// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "core/estimate/point_lanes.hpp"
#include "core/estimate/wall_doubt.hpp"
#include "core/map/ray_caster.hpp"
#include "core/map/wall_map.hpp"
#include "core/polar_scan.hpp"
#include "core/sensor_noise.hpp"

namespace cornerd::core {

struct RefinedPose {
  Pose2 T_map_lidar;
  Covariance3 covariance = Covariance3::Zero();  ///< x, y in the map frame, theta
  std::size_t inliers = 0;
  double rmse_m = 0;  ///< of the inliers' distances to their walls
  double spread = 0;  ///< of the same in units of the noise: 1 where the model is right
  WallResiduals walls;
  bool valid = false;  ///< false: the points do not determine the pose
};

/// What is known of the pose besides the points.
struct PosePrior {
  Pose2 T_map_lidar;
  Eigen::Matrix3d information =
      Eigen::Matrix3d::Zero();  ///< of x, y, theta; as a covariance's inverse
};

struct RefinedMotion {
  Pose2 T_map_lidar;
  Twist2 motion;  ///< in addition to the one that the points were moved back by
  bool valid = false;
};

/// Maximum likelihood fit of all wall points to the faces that the place can see, by Gauss-Newton
/// on point-to-face distances with a redescending loss. After each step that moves the lidar it is
/// predicted anew which face a ray meets, so that the far side of a thin wall never attracts a
/// point of the near one.
class Refinement {
 public:
  Refinement(double max_range_m, const SensorNoise& noise);

  /// From a place that is off by up to `reach_m`. `thin`: a selection of `points` for the first
  /// steps, which need no precision.
  RefinedPose refine(const WallMap& map, const Pose2& start, double reach_m,
                     std::span<const PolarPoint> thin, std::span<const PolarPoint> points,
                     double noise_scale, const PosePrior* prior = nullptr);

  /// The same by few points and no more steps than it takes to tell whether the place may be right.
  RefinedPose approach(const WallMap& map, const Pose2& start, double reach_m,
                       std::span<const PolarPoint> thin, double noise_scale);

  /// The same for a robot whose motion within the turn is not known: estimates it along with the
  /// pose. A turn has far more points than the six unknowns; a weak belief in rest keeps a
  /// direction in which no wall is seen from running away.
  RefinedMotion refine_motion(const WallMap& map, const Pose2& start, double reach_m,
                              std::span<const PolarPoint> points, double noise_scale);

 private:
  struct Step;
  /// `last_steps`: at most so many on `points`.
  RefinedPose descend(const WallMap& map, const Pose2& start, double reach_m,
                      std::span<const PolarPoint> thin, std::span<const PolarPoint> points,
                      double noise_scale, int last_steps, const PosePrior* prior);
  /// Which face each of the points meets, seen from here.
  void look(const WallMap& map, const Pose2& T_map_lidar, std::span<const PolarPoint> points,
            double noise_scale, double slack_m);
  /// Of what was looked at last.
  Step step(const WallMap& map, const Pose2& T_map_lidar, double slack_m);

  SensorNoise noise_;
  RayCaster prediction_;
  PointLanes lanes_;
  std::span<const PolarPoint> seen_;  ///< the points in the lanes, and that `hits_` belong to
  std::span<const PredictedHit> hits_;
  std::vector<FacePull> pulls_;  ///< of the last step
  Pose2 T_map_seen_;             ///< where `hits_` were predicted from
};

}  // namespace cornerd::core
