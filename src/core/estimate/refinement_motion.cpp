// SPDX-License-Identifier: MIT
// A pose and the motion during its scan, refined together.
#include <algorithm>
#include <cmath>

#include "core/estimate/refinement.hpp"
#include "core/geometry/linear_solve.hpp"

namespace cornerd::core {
namespace {

constexpr int kMotionIterations = 8;
/// More points than this determine a motion no better than refinement needs.
constexpr std::size_t kMotionPoints = 512;
constexpr double kFinest_m = 1e-3;
constexpr double kMotionConverged = 1e-4;  // m, rad
/// Prior standard deviations of the robot's velocity.
constexpr double kMotionSigma_m_s = 0.5;
constexpr double kMotionSigma_rad_s = 2;

}  // namespace

RefinedMotion Refinement::refine_motion(const WallMap& map, const Pose2& start,
                                        double search_radius_m, std::span<const PolarPoint> points,
                                        double noise_scale) {
  using Vector6 = Eigen::Matrix<double, 6, 1>;
  using Matrix6 = Eigen::Matrix<double, 6, 6>;
  const Vector6 prior_information =
      (Vector6() << 0, 0, 0, 1 / (kMotionSigma_m_s * kMotionSigma_m_s),
       1 / (kMotionSigma_m_s * kMotionSigma_m_s), 1 / (kMotionSigma_rad_s * kMotionSigma_rad_s))
          .finished();
  RefinedMotion refined;
  refined.T_map_lidar = start;
  Eigen::Vector3d twist = Eigen::Vector3d::Zero();
  double extra_sigma_m = search_radius_m;
  const std::size_t stride = std::max<std::size_t>(1, points.size() / kMotionPoints);
  for (int k = 0; k < kMotionIterations; ++k) {
    const Pose2& T_map_lidar = refined.T_map_lidar;
    const auto hits = k == 0 ? ray_caster_.cast_near(map, T_map_lidar, points)
                             : ray_caster_.cast_again(map, T_map_lidar, points);
    const double c = std::cos(T_map_lidar.theta_rad);
    const double s = std::sin(T_map_lidar.theta_rad);
    Matrix6 information = prior_information.asDiagonal();
    Vector6 gradient = Vector6::Zero();
    gradient.tail<3>() = prior_information.tail<3>().cwiseProduct(twist);
    std::size_t inliers = 0;
    for (std::size_t i = 0; i < points.size(); i += stride) {
      if (hits[i].face == PredictedHit::kNone) continue;
      const PolarPoint& point = points[i];
      const Face& face = map.faces()[hits[i].face];
      // In the lidar's frame: the wall's normal, and the point deskewed by the motion so far.
      const Vec2 normal(c * face.normal.x() + s * face.normal.y(),
                        c * face.normal.y() - s * face.normal.x());
      const double x_m = point.x_m + point.dt_s * (twist.x() - twist.z() * point.y_m);
      const double y_m = point.y_m + point.dt_s * (twist.y() + twist.z() * point.x_m);
      const double height_m = face.normal.dot(T_map_lidar.translation()) - face.offset_m;
      const double distance_m = normal.x() * x_m + normal.y() * y_m + height_m;
      const double sine = std::abs(normal.x() * point.ray_x + normal.y() * point.ray_y);
      const double variance =
          noise_.variance_across_m2(point.range_m, sine) * noise_scale * noise_scale +
          extra_sigma_m * extra_sigma_m;
      const double share = 1 - distance_m * distance_m /
                                   (variance * PointLanes::kCutSigmas * PointLanes::kCutSigmas);
      if (share <= 0) continue;
      const double weight = share * share / variance;
      const Eigen::Vector3d jacobian(normal.x(), normal.y(), normal.y() * x_m - normal.x() * y_m);
      Vector6 jacobians;
      jacobians << jacobian, point.dt_s * jacobian;
      information.noalias() += weight * jacobians * jacobians.transpose();
      gradient.noalias() += weight * distance_m * jacobians;
      ++inliers;
    }
    const SymmetricSolver<6> solver(information);
    if (inliers < kMinInliers || !solver.succeeded()) return refined;
    const Vector6 move = solver.solve(gradient);
    if (!move.allFinite()) return refined;
    refined.T_map_lidar = T_map_lidar * Pose2{-move[0], -move[1], -move[2]};
    twist -= move.tail<3>();
    if (extra_sigma_m == kFinest_m && move.norm() < kMotionConverged) break;
    extra_sigma_m = std::max(0.4 * extra_sigma_m, kFinest_m);
  }
  refined.motion = {twist.x(), twist.y(), twist.z()};
  refined.valid = true;
  return refined;
}

}  // namespace cornerd::core
