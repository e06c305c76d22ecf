// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "core/estimate/map_error_model.hpp"
#include "core/estimate/point_lanes.hpp"
#include "core/estimate/wall_offset_filter.hpp"
#include "core/map/ray_caster.hpp"
#include "core/map/wall_map.hpp"
#include "core/polar_scan.hpp"
#include "core/sensor_noise.hpp"

namespace cornerd::core {

struct NormalEquations;

struct RefinedPose {
  /// What noise beyond the model adds to `covariance`.
  Covariance3 excess_covariance() const {
    return (std::max(1.0, reduced_chi_square) - 1) * noise_covariance;
  }
  /// `covariance` if the noise is as modelled.
  Covariance3 nominal_covariance() const { return covariance - excess_covariance(); }

  Pose2 T_map_lidar;
  Covariance3 covariance = Covariance3::Zero();        ///< x, y in the map frame, theta
  Covariance3 noise_covariance = Covariance3::Zero();  ///< by the points' noise alone
  std::size_t inliers = 0;
  /// Inliers by how much their walls' normals are along the direction in which walls determine the
  /// place least: those that tell where along a corridor it is.
  double least_inliers = 0;
  /// A wall holds the place in each direction, and not a few rays at the edges of niches, which fit
  /// by chance wherever they are.
  bool is_held() const { return least_inliers >= kLeastInliers; }
  static constexpr double kLeastInliers = 6;
  double rmse_m = 0;              ///< of the inliers' distances to their walls
  double reduced_chi_square = 0;  ///< of the inliers; 1 where the model is right
  double spread = 0;              ///< the same by the sensor's noise, of walls that seem uneven too
  double map_sigma_m = 0;         ///< of the faces' offsets, by what the scan shows of them
  double direction_share = 0;     ///< shown_direction_share(), where offsets were estimated
  /// The scan does not show that walls are parallel: they may be turned by a tenth of what their
  /// ends may be off.
  bool shows_directions() const { return direction_share > kLeastDirectionShare; }
  static constexpr double kLeastDirectionShare = 0.1 * 0.1;
  FaceResidualStatistics face_residuals;
  bool valid = false;  ///< false: the points do not determine the pose
};

/// Gaussian prior of the pose.
struct PosePrior {
  Pose2 T_map_lidar;
  Eigen::Matrix3d information =
      Eigen::Matrix3d::Zero();  ///< of x, y, theta: the inverse covariance

  /// How far a refinement goes from its start along what its points leave open: in a corridor few
  /// rays meet a niche, and none of a subset's may.
  static PosePrior near_to(const Pose2& T_map_lidar);
};

struct RefinedMotion {
  Pose2 T_map_lidar;
  ScanMotion motion;  ///< in addition to the one that the points were deskewed by
  bool valid = false;
};

/// Robust maximum likelihood fit of all wall points to the visible faces: Gauss-Newton on
/// point-to-face distances with Tukey's biweight. Ray casting assigns the faces anew after each
/// step, so that the far side of a thin wall never attracts points of the near side.
class Refinement {
 public:
  Refinement(double max_range_m, const SensorNoise& noise);

  /// `start` may be off by `search_radius_m`. `subset`: some of `points`, for the first steps,
  /// which need no precision. `map_sigma_m`: standard deviation of each face's offset, which is
  /// marginalised, so that the covariance knows of it (Probabilistic Robotics, section 3.5.4).
  /// `walls`: what was learned of the offsets, jointly; it holds the last step afterwards.
  RefinedPose refine(const WallMap& map, const Pose2& start, double search_radius_m,
                     std::span<const PolarPoint> subset, std::span<const PolarPoint> points,
                     double noise_scale, double map_sigma_m = 0, const PosePrior* prior = nullptr,
                     WallOffsetFilter* walls = nullptr);

  /// The same from a pose that was refined as if walls were off as a whole: each face's direction
  /// is marginalised besides. A place is judged by the pose before, at which walls fit better than
  /// they should.
  RefinedPose refine_directions(const WallMap& map, const RefinedPose& parallel,
                                std::span<const PolarPoint> points, double noise_scale,
                                double map_sigma_m, WallOffsetFilter* walls = nullptr);

  /// The same on few points, near to the start, with only the steps that a rejection test needs.
  RefinedPose refine_roughly(const WallMap& map, const Pose2& start, double search_radius_m,
                             std::span<const PolarPoint> subset, double noise_scale,
                             double map_sigma_m = 0);

  /// The same for an unknown motion within the scan: estimates pose, velocity and, where it
  /// `accelerates`, the angular acceleration (six or seven unknowns). A weak prior at rest bounds
  /// directions in which no wall is seen.
  RefinedMotion refine_motion(const WallMap& map, const Pose2& start, double search_radius_m,
                              std::span<const PolarPoint> points, double noise_scale,
                              bool accelerates);

  /// How much a refined pose (x, y in the map frame, theta; m, rad) is off for a velocity of the
  /// lidar by which `points` should have been deskewed in addition (vx, vy in its own axes, omega;
  /// m/s, rad/s). Zero where the points determine no pose.
  Eigen::Matrix3d error_per_velocity(const WallMap& map, const Pose2& T_map_lidar,
                                     std::span<const PolarPoint> points, double noise_scale);

 private:
  static constexpr std::size_t kMinInliers = 8;
  /// So many give NEES within 0.1 of what 800 give in drives that start and stop, at a third of
  /// the cost.
  static constexpr std::size_t kFewPoints = 96;
  /// `max_final_steps`: limit of the steps on all `points`.
  RefinedPose gauss_newton(const WallMap& map, const Pose2& start, double search_radius_m,
                           std::span<const PolarPoint> subset, std::span<const PolarPoint> points,
                           double noise_scale, double map_sigma_m, int max_final_steps,
                           const PosePrior* prior, WallOffsetFilter* walls);
  /// The face that each point's ray hits from this pose.
  void find_hits(const WallMap& map, const Pose2& T_map_lidar, std::span<const PolarPoint> points,
                 double noise_scale, double extra_sigma_m);
  /// Normal equations of the last hits.
  NormalEquations step(const WallMap& map, const Pose2& T_map_lidar, double extra_sigma_m,
                       double map_sigma_m, WallOffsetFilter* walls);

  SensorNoise noise_;
  RayCaster ray_caster_;
  PointLanes lanes_;
  std::span<const PolarPoint> points_;  ///< that `lanes_` and `hits_` are of
  std::span<const PredictedHit> hits_;
  std::vector<FaceResidual> residuals_;  ///< of the last step, or refine()
  double uneven_share_ = 1;              ///< of walls, of what they are off
  double direction_share_ = 0;           ///< of walls, of their directions' variance
  std::vector<PolarPoint> few_;          ///< of error_per_velocity()
  Pose2 T_map_hits_;                     ///< where `hits_` were cast from
};

}  // namespace cornerd::core
