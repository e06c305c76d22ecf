// SPDX-License-Identifier: MIT
// A pose and the motion during its scan, refined together.
#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "core/estimate/refinement.hpp"
#include "core/geometry/linear_solve.hpp"
#include "core/geometry/squared.hpp"

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
/// Robots that rotate at 1.5 to 3 rad/s reach that within a scan or two.
constexpr double kMotionSigma_rad_s2 = 10;
/// As good as none.
constexpr double kSteadySigma_rad_s2 = 1e-6;

}  // namespace

RefinedMotion Refinement::refine_motion(const WallMap& map, const Pose2& start,
                                        double search_radius_m, std::span<const PolarPoint> points,
                                        double noise_scale, bool accelerates) {
  using Vector7 = Eigen::Matrix<double, 7, 1>;
  using Matrix7 = Eigen::Matrix<double, 7, 7>;
  const Vector7 prior_information =
      (Vector7() << 0, 0, 0, 1 / squared(kMotionSigma_m_s), 1 / squared(kMotionSigma_m_s),
       1 / squared(kMotionSigma_rad_s),
       1 / squared(accelerates ? kMotionSigma_rad_s2 : kSteadySigma_rad_s2))
          .finished();
  RefinedMotion refined;
  refined.T_map_lidar = start;
  Eigen::Vector4d motion = Eigen::Vector4d::Zero();  // velocity, angular acceleration
  double extra_sigma_m = search_radius_m;
  const std::size_t stride = std::max<std::size_t>(1, points.size() / kMotionPoints);
  for (int k = 0; k < kMotionIterations; ++k) {
    const Pose2& T_map_lidar = refined.T_map_lidar;
    const auto hits = k == 0 ? ray_caster_.cast_near(map, T_map_lidar, points)
                             : ray_caster_.cast_again(map, T_map_lidar, points);
    const double c = std::cos(T_map_lidar.theta_rad);
    const double s = std::sin(T_map_lidar.theta_rad);
    Matrix7 information = prior_information.asDiagonal();
    Vector7 gradient = Vector7::Zero();
    gradient.tail<4>() = prior_information.tail<4>().cwiseProduct(motion);
    std::size_t inliers = 0;
    for (std::size_t i = 0; i < points.size(); i += stride) {
      if (hits[i].face == PredictedHit::kNone) continue;
      const PolarPoint& point = points[i];
      const Face& face = map.faces()[hits[i].face];
      // In the lidar's frame: the wall's normal, and the point deskewed by the motion so far.
      const Vec2 normal(c * face.normal.x() + s * face.normal.y(),
                        c * face.normal.y() - s * face.normal.x());
      const double rotation_rad = (motion[2] + motion[3] / 2 * point.dt_s) * point.dt_s;
      const double x_m = point.x_m + point.dt_s * motion[0] - rotation_rad * point.y_m;
      const double y_m = point.y_m + point.dt_s * motion[1] + rotation_rad * point.x_m;
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
      Vector7 jacobians;
      jacobians << jacobian, point.dt_s * jacobian, squared(point.dt_s) / 2 * jacobian.z();
      information.selfadjointView<Eigen::Lower>().rankUpdate(jacobians, weight);
      gradient.noalias() += weight * distance_m * jacobians;
      ++inliers;
    }
    const SymmetricSolver<7> solver(information);
    if (inliers < kMinInliers || !solver.succeeded()) return refined;
    const Vector7 move = solver.solve(gradient);
    if (!move.allFinite()) return refined;
    refined.T_map_lidar = T_map_lidar * Pose2{-move[0], -move[1], -move[2]};
    motion -= move.tail<4>();
    if (extra_sigma_m == kFinest_m && move.head<6>().norm() < kMotionConverged) break;
    extra_sigma_m = std::max(0.4 * extra_sigma_m, kFinest_m);
  }
  refined.motion = {Twist2{motion[0], motion[1], motion[2]}, motion[3]};
  refined.valid = true;
  return refined;
}

Eigen::Matrix3d Refinement::error_per_velocity(const WallMap& map, const Pose2& T_map_lidar,
                                               std::span<const PolarPoint> points,
                                               double noise_scale) {
  take_few(points, kFewPoints, few_);
  const auto hits = ray_caster_.cast(map, T_map_lidar, few_);
  const double c = std::cos(T_map_lidar.theta_rad);
  const double s = std::sin(T_map_lidar.theta_rad);
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  Eigen::Matrix3d coupled = Eigen::Matrix3d::Zero();  // of pose and velocity
  for (std::size_t i = 0; i < few_.size(); ++i) {
    if (hits[i].face == PredictedHit::kNone) continue;
    const PolarPoint& point = few_[i];
    const Face& face = map.faces()[hits[i].face];
    const Vec2 normal(c * face.normal.x() + s * face.normal.y(),
                      c * face.normal.y() - s * face.normal.x());
    const double distance_m =
        normal.dot(point.position()) + face.normal.dot(T_map_lidar.translation()) - face.offset_m;
    const double sine = std::abs(normal.dot(point.ray()));
    const double variance =
        noise_.variance_across_m2(point.range_m, sine) * noise_scale * noise_scale;
    const double share = 1 - distance_m * distance_m / (variance * squared(PointLanes::kCutSigmas));
    if (share <= 0) continue;
    const Eigen::Vector3d jacobian(normal.x(), normal.y(),
                                   normal.y() * point.x_m - normal.x() * point.y_m);
    const Eigen::Matrix3d of_point = share * share / variance * jacobian * jacobian.transpose();
    information += of_point;
    coupled += point.dt_s * of_point;
  }
  const SymmetricSolver<3> solver(information);
  if (!solver.succeeded() || !solver.is_positive()) return Eigen::Matrix3d::Zero();
  Eigen::Matrix3d error = solver.inverse() * coupled;  // in the lidar's frame
  error.topRows<2>() =
      Eigen::Rotation2Dd(T_map_lidar.theta_rad).toRotationMatrix() * error.topRows<2>().eval();
  return error;
}

}  // namespace cornerd::core
