// SPDX-License-Identifier: MIT
#include "core/estimate/refinement.hpp"

#include <algorithm>
#include <cmath>

#include "core/estimate/face_offsets.hpp"
#include "core/estimate/normal_equations.hpp"
#include "core/geometry/linear_solve.hpp"
#include "core/geometry/squared.hpp"

namespace cornerd::core {
namespace {

constexpr double kCutSigmas = PointLanes::kCutSigmas;
constexpr int kMaxSteps = 12;
/// Poses are twice as uncertain; smaller steps moved no mean of `cornerd-bench --localizer` by 1 %.
constexpr double kConverged_m = 1e-4;
constexpr double kConverged_rad = 5e-5;
/// A smaller step leaves each ray on the face that it hit before, except near a face's end.
constexpr double kSameHits_m = 2e-3;
constexpr double kSameHits_rad = 1e-3;
/// The same, as a share of the extra sigma while that is large.
constexpr double kSameHitsShare = 0.25;
/// Relative pivot below which the visible walls do not determine the pose: a single wall, a bare
/// corridor.
constexpr double kMinPivot = 1e-7;
/// Standard deviation of points of a wall about its own plane, over the sigma of walls' offsets:
/// all of it where the map states that sigma, as one does that a robot made in cells (of 357 scans
/// of recordings/olin 0.5 names 327, 1 339, 1.5 335); else what the scan shows, down to this.
constexpr double kEvenShare = 0.1;
/// Runs of neighbouring rays on one face in a scan; more faces are left out.
constexpr std::size_t kMaxResiduals = 1024;
/// Standard deviation of an offset that tells nothing of the pose.
constexpr double kUnknown_m = 1e3;
/// Standard deviations of PosePrior::near_to().
constexpr double kOpen_m = 0.2;
constexpr double kOpen_rad = 0.2;

}  // namespace

PosePrior PosePrior::near_to(const Pose2& T_map_lidar) {
  const Eigen::Vector3d sigma(kOpen_m, kOpen_m, kOpen_rad);
  return {T_map_lidar, sigma.cwiseAbs2().cwiseInverse().asDiagonal()};
}

Refinement::Refinement(double max_range_m, const SensorNoise& noise)
    : noise_(noise), ray_caster_(max_range_m) {
  residuals_.reserve(kMaxResiduals);
  few_.reserve(2 * kFewPoints);
}

void Refinement::find_hits(const WallMap& map, const Pose2& T_map_lidar,
                           std::span<const PolarPoint> points, double noise_scale,
                           double extra_sigma_m) {
  const double same_m = std::max(kSameHits_m, kSameHitsShare * extra_sigma_m);
  const double same_rad = kSameHits_rad / kSameHits_m * same_m;
  const bool same_points = points.data() == points_.data() && points.size() == points_.size();
  if (same_points && same_pose(T_map_lidar, T_map_hits_, same_m, same_rad)) return;
  if (!same_points) lanes_.assign(points, noise_, noise_scale);
  hits_ = same_points ? ray_caster_.cast_again(map, T_map_lidar, points)
                      : ray_caster_.cast_near(map, T_map_lidar, points);
  points_ = points;
  T_map_hits_ = T_map_lidar;
}

NormalEquations Refinement::step(const WallMap& map, const Pose2& T_map_lidar, double extra_sigma_m,
                                 double map_sigma_m, WallOffsetFilter* walls) {
  const double c = std::cos(T_map_lidar.theta_rad);
  const double s = std::sin(T_map_lidar.theta_rad);
  NormalEquations sums;
  sums.uneven_share = uneven_share_;
  residuals_.clear();
  if (walls != nullptr) walls->begin(direction_share_);
  // Neighbouring rays mostly hit the same face: each run is summed at once.
  for (std::size_t begin = 0, end = 0; begin < hits_.size(); begin = end) {
    const std::uint32_t met = hits_[begin].face;
    while (end < hits_.size() && hits_[end].face == met) ++end;
    if (met == PredictedHit::kNone) continue;
    const Face& face = map.faces()[met];
    const double nx = face.normal.x();
    const double ny = face.normal.y();
    double height_m = nx * T_map_lidar.x_m + ny * T_map_lidar.y_m - face.offset_m;
    double face_sigma_m = std::max(map_sigma_m, face.sigma_m);
    if (walls != nullptr) {
      height_m -= walls->offset_m(met);
      if (const double learned_m = walls->sigma_m(met); learned_m > 0) face_sigma_m = learned_m;
    }
    const Vec2 normal(c * nx + s * ny, c * ny - s * nx);
    FaceSums sum = lanes_.sum(begin, end, normal, height_m, extra_sigma_m, face_sigma_m);
    if (extra_sigma_m == 0 && face_sigma_m > 0 && sum.weight > 0) {
      const double offset_m = sum.distance / sum.weight;
      const double lever_m = sum.mean_lever_m();
      const double angle_rad =
          sum.direction_rad(direction_share_ * direction_variance(face.length_m, face_sigma_m));
      sum = lanes_.sum(begin, end, normal, height_m - offset_m + angle_rad * lever_m,
                       uneven_share_ * face_sigma_m, 0, angle_rad);
      sums.uneven_points += sum.points;
      sums.uneven_square += sum.z_squared;
      sums.uneven_weight += sum.weight * squared(face_sigma_m);
      sum.move(offset_m, angle_rad, lever_m);
    }
    const FaceResidual residual{sum, met, face.normal, face.length_m};
    if (residuals_.size() == kMaxResiduals) merge_by_face(residuals_);
    if (residuals_.size() < kMaxResiduals) residuals_.push_back(residual);
    sums.information(0, 0) += sum.weight * nx * nx;
    sums.information(0, 1) += sum.weight * nx * ny;
    sums.information(1, 1) += sum.weight * ny * ny;
    sums.information(0, 2) += sum.lever * nx;
    sums.information(1, 2) += sum.lever * ny;
    sums.information(2, 2) += sum.lever_squared;
    sums.gradient += Eigen::Vector3d(sum.distance * nx, sum.distance * ny, sum.distance_lever);
    sums.chi_square += sum.z_squared;
    if (walls != nullptr && !walls->add(met, face.normal, sum, end - begin)) {
      // Its offset is the same in each scan, and would pass for news of the frame.
      sums.marginalise(residual, kUnknown_m);
    }
    sums.squared_distances += sum.squared_distances;
    sums.inliers += static_cast<std::size_t>(sum.points);
    sums.normals += sum.points * face.normal * face.normal.transpose();
  }
  // Stretches of uneven walls are off, each by itself.
  if (!map.plan().is_inexact()) merge_by_face(residuals_);
  for (const FaceResidual& face : residuals_) {
    const double face_sigma_m = std::max(map_sigma_m, map.faces()[face.face].sigma_m);
    if (!(face_sigma_m > 0 && face.weight > 0)) continue;
    if (walls == nullptr) sums.marginalise(face, face_sigma_m);
    sums.marginalise_direction(face, direction_share_ * face.direction_variance(face_sigma_m));
  }
  if (walls != nullptr) {
    const WallOffsetFilter::Reduced reduced = walls->marginalise();
    sums.of_offsets += reduced.information;
    sums.gradient -= reduced.gradient;
    sums.gradient_of_offsets += reduced.gradient;
    sums.chi_square -= reduced.chi_square;
  }
  sums.information.triangularView<Eigen::StrictlyLower>() = sums.information.transpose();
  sums.information -= sums.of_offsets;
  sums.information(2, 2) -= sums.of_directions;
  sums.gradient.z() -= sums.heading_of_directions;
  return sums;
}

RefinedPose Refinement::refine(const WallMap& map, const Pose2& start, double search_radius_m,
                               std::span<const PolarPoint> subset,
                               std::span<const PolarPoint> points, double noise_scale,
                               double map_sigma_m, const PosePrior* prior,
                               WallOffsetFilter* walls) {
  direction_share_ = 0;
  RefinedPose refined = gauss_newton(map, start, search_radius_m, subset, points, noise_scale,
                                     map_sigma_m, kMaxSteps, prior, walls);
  if (refined.valid) {
    FaceResidualStatistics& faces = refined.face_residuals;
    faces = face_residual_statistics(residuals_, refined.noise_covariance);
    merge_by_line(residuals_, map);
    faces.covariance_per_variance = covariance_per_variance(residuals_, refined.noise_covariance);
    faces.log_odds_of_tape =
        log_odds_of_tape(residuals_, refined.noise_covariance, faces.shown_variance_m2());
  }
  return refined;
}

RefinedPose Refinement::refine_directions(const WallMap& map, const RefinedPose& parallel,
                                          std::span<const PolarPoint> points, double noise_scale,
                                          double map_sigma_m, WallOffsetFilter* walls) {
  direction_share_ = parallel.direction_share;
  const PosePrior prior = PosePrior::near_to(parallel.T_map_lidar);
  // A prior of each scan's pose would pass for news of the frame of learned walls.
  RefinedPose refined =
      gauss_newton(map, parallel.T_map_lidar, 0, points, points, noise_scale, map_sigma_m,
                   kMaxSteps, walls == nullptr ? &prior : nullptr, walls);
  refined.face_residuals = parallel.face_residuals;
  return refined;
}

RefinedPose Refinement::refine_roughly(const WallMap& map, const Pose2& start,
                                       double search_radius_m, std::span<const PolarPoint> subset,
                                       double noise_scale, double map_sigma_m) {
  const PosePrior prior = PosePrior::near_to(start);
  direction_share_ = 0;
  return gauss_newton(map, start, search_radius_m, subset, subset, noise_scale, map_sigma_m, 1,
                      &prior, nullptr);
}

RefinedPose Refinement::gauss_newton(const WallMap& map, const Pose2& start, double search_radius_m,
                                     std::span<const PolarPoint> subset,
                                     std::span<const PolarPoint> points, double noise_scale,
                                     double map_sigma_m, int max_final_steps,
                                     const PosePrior* prior, WallOffsetFilter* walls) {
  RefinedPose refined;
  refined.T_map_lidar = start;
  double extra_sigma_m = search_radius_m;
  SymmetricSolver<3> solver;
  NormalEquations sums;
  // A rough refinement makes one step, and nobody asks it for directions.
  const bool shows_directions = map_sigma_m > 0 && max_final_steps == kMaxSteps;
  const bool shows_sigma = map_sigma_m > 0 && walls == nullptr && !map.plan().is_inexact();
  const double stated_m = map_sigma_m;
  uneven_share_ = 1;
  points_ = {};
  const auto shown_by = [&](const NormalEquations& of) {
    return shown_direction_share(residuals_, map, map_sigma_m, of.information_of_parallel(),
                                 of.gradient_of_parallel());
  };
  for (int k = 0; k < kMaxSteps; ++k) {
    const bool rough = extra_sigma_m > 0.004;
    const double step_extra_sigma_m = rough ? extra_sigma_m : 0;
    find_hits(map, refined.T_map_lidar, rough ? subset : points, noise_scale, step_extra_sigma_m);
    sums = step(map, refined.T_map_lidar, step_extra_sigma_m, map_sigma_m, walls);
    if (prior != nullptr) {
      const Pose2& at = refined.T_map_lidar;
      sums.information += prior->information;
      sums.gradient +=
          prior->information *
          Eigen::Vector3d(at.x_m - prior->T_map_lidar.x_m, at.y_m - prior->T_map_lidar.y_m,
                          angle_between(prior->T_map_lidar.theta_rad, at.theta_rad));
    }
    solver.compute(sums.information);
    const Eigen::Vector3d pivots = solver.pivots();
    if (sums.inliers < kMinInliers || !(pivots.minCoeff() > kMinPivot * pivots.maxCoeff())) {
      return refined;
    }
    const Eigen::Vector3d move = solver.solve(sums.gradient);
    refined.T_map_lidar.x_m -= move.x();
    refined.T_map_lidar.y_m -= move.y();
    refined.T_map_lidar.theta_rad = normalize_angle(refined.T_map_lidar.theta_rad - move.z());
    const bool converged =
        move.head<2>().norm() < kConverged_m && std::abs(move.z()) < kConverged_rad;
    if (!rough && (converged || --max_final_steps == 0)) break;
    extra_sigma_m *= 0.4;
    if (rough) continue;
    if (shows_sigma && sums.uneven_weight > 0) {
      map_sigma_m = sigma_of_offsets(residuals_, map, stated_m, map_sigma_m);
      uneven_share_ = std::clamp(sums.shown_share(), kEvenShare, 1.0);
    }
    if (direction_share_ > 0) direction_share_ = shown_by(sums);
  }
  refined.map_sigma_m = map_sigma_m;
  if (shows_directions) refined.direction_share = shown_by(sums);
  const auto inliers = static_cast<double>(sums.inliers);
  refined.reduced_chi_square = sums.chi_square / std::max(1.0, inliers - 3);
  refined.spread = refined.reduced_chi_square;
  if (shows_sigma && sums.uneven_weight > 0) refined.spread *= sums.variance_over_sensor();
  refined.covariance = solver.inverse();
  refined.noise_covariance = refined.covariance;
  if (!sums.of_offsets.isZero(0)) {
    solver.compute(sums.information_of_parallel() + sums.of_offsets);
    refined.noise_covariance = solver.inverse();
  }
  // To the pose that fits the points best.
  const Eigen::Vector3d move =
      refined.noise_covariance * (sums.gradient_of_parallel() + sums.gradient_of_offsets);
  if (walls == nullptr && map_sigma_m > 0) {
    const Covariance3 noise = refined.covariance;
    refined.covariance += noise * variance_of_lines(residuals_, map, map_sigma_m) * noise;
  }
  for (FaceResidual& face : residuals_) face.move_pose(-move);
  refined.covariance += refined.excess_covariance();
  refined.inliers = sums.inliers;
  const Eigen::Matrix2d& normals = sums.normals;
  refined.least_inliers =
      (normals.trace() - std::hypot(normals(0, 0) - normals(1, 1), 2 * normals(0, 1))) / 2;
  refined.rmse_m = std::sqrt(sums.squared_distances / std::max(1.0, inliers));
  refined.valid = refined.covariance.allFinite();
  return refined;
}

}  // namespace cornerd::core
