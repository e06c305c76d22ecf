// SPDX-License-Identifier: MIT
// The robot's motion within a scan, from the scan itself.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/geometry/squared.hpp"
#include "core/localizer_workspace.hpp"

namespace cornerd::core {
namespace {

/// A place found in a scan in motion is off by the motion.
constexpr double kMotionSearchRadius_m = 0.08;

/// A motion has to explain a scan better than rest by so much: it fits things that are not on the
/// map a little, always. Fewer make poses in motion no better, more make them worse
/// (`cornerd-bench --localizer`).
constexpr double kNatsPerRayOfMotion = 0.05;

/// Residuals this much beyond the scan's noise may be a motion's (reduced chi-square; 1.15 is three
/// standard deviations of 800 rays'). Where all else fits, only what is more is looked into.
constexpr double kMayMove = 1.15;
constexpr double kSurelyMoves = 1.4;

/// Rotation rates that are tried where nothing measures them: small robots rotate at up to 3 rad/s,
/// and refinement corrects half a radian per second.
constexpr std::array kTriedRates_rad_s = {1.0, -1.0, 2.0, -2.0, 3.0, -3.0};

/// A scan in a slower rotation is not smeared beyond what refinement corrects.
constexpr double kTurning_rad_s = 0.3;

/// Standard deviation of the velocity of a robot of which nothing is known: most stand when they
/// are asked for the first time.
constexpr double kDrives_m_s = 0.1;
constexpr double kDrives_rad_s = 0.3;

/// A scan fits as it came where as many rays hit as do in an exact map but for some furniture.
constexpr double kMovingHitShare = 0.8;

/// A yaw rate that changes by so much from scan to scan turns the walls of a scan, on average, by
/// this much of it against those at its middle: 1/24 of an A1's 0.137 s.
constexpr double kUnsteady_s = 0.0057;

}  // namespace

/// Nothing fits, or not as well as a lidar at rest would see it.
bool Localizer::Workspace::may_move(TimeNs t_ns) const {
  if (!place || trusts_odometry()) return false;
  const auto& exact = place->place_search.exact();
  // Walls that are off explain all that a motion would.
  const auto places = place->place_search.places();
  if (sees_enough(t_ns) && !places.empty() && places.front().map_sigma_m > 0 &&
      is_in_map(places.front()) && places.front().refined.spread < kMayMove) {
    return false;
  }
  return !exact ||
         exact->refined.reduced_chi_square > (is_conclusive(t_ns) ? kSurelyMoves : kMayMove);
}

BeamCounts Localizer::Workspace::best_rays() const {
  if (!place || !place->place_search.exact()) return {};
  return place->place_search.exact()->rays;
}

bool Localizer::Workspace::explains_more(const BeamCounts& rays, const BeamCounts& than) const {
  return rays.rays > 0 &&
         (than.rays == 0 ||
          rays.log_likelihood >
              than.log_likelihood + kNatsPerRayOfMotion * static_cast<double>(points.size()));
}

bool Localizer::Workspace::is_explained_by_offsets(const Scan& scan, TimeNs t_ns) {
  const auto& exact = place->place_search.exact();
  if (!exact || place->map_error.is_exact() || !exact->refined.face_residuals.shows_offsets()) {
    return false;
  }
  const auto spread = [&](const PolarScan& as_seen) {
    const RefinedPose refined = place->refinement.refine(
        *map, exact->refined.T_map_lidar, kMotionSearchRadius_m, as_seen.points(), as_seen.points(),
        noise_scale(), map->plan().sigma_m);
    return refined.valid ? refined.spread : std::numeric_limits<double>::infinity();
  };
  tried_points.assign(scan, config.min_range_m, config.max_range_m, t_ns, memory.motion(),
                      place->bias.bias());
  return spread(tried_points) < kMayMove * spread(points);
}

bool Localizer::Workspace::is_half_explained() const {
  const std::size_t hits = best_rays().hits;
  return hits > 0 && hits >= points.size() / 2;
}

VerifiedHypothesis Localizer::Workspace::try_at(const Scan& scan, TimeNs t_ns,
                                                const ScanMotion& as_if, const Pose2& T_map_lidar,
                                                const SensorBias& bias) {
  tried_points.assign(scan, config.min_range_m, config.max_range_m, t_ns, as_if, bias);
  place->trial.begin(tried_points, {.noise_scale = noise_scale()});
  return place->trial.exactly(T_map_lidar, kMotionSearchRadius_m);
}

void Localizer::Workspace::refine_motion(const Scan& scan, TimeNs t_ns) {
  if (!may_move(t_ns) || best_rays().hits == 0) return;
  // Where walls have been exact, what does not fit is a motion. A first scan fits too much already.
  const bool accelerates = place->map_error.is_exact() && memory.prior(t_ns).has_value();
  ScanMotion found = motion;
  VerifiedHypothesis best = *place->place_search.exact();
  const PolarScan* seen = &points;
  for (int k = 0; k < 2 && best.refined.reduced_chi_square > kMayMove; ++k) {
    const RefinedMotion refined =
        place->refinement.refine_motion(*map, best.refined.T_map_lidar, kMotionSearchRadius_m,
                                        seen->points(), result.detection.noise_scale, accelerates);
    if (!refined.valid || !is_plausible(refined.motion.twist)) break;
    const VerifiedHypothesis fit =
        try_at(scan, t_ns, found + refined.motion, refined.T_map_lidar, place->bias.bias());
    if (!explains_more(fit.rays, best.rays)) break;
    found = found + refined.motion;
    best = fit;
    seen = &tried_points;
  }
  if (found != motion) look(scan, t_ns, found);
}

bool Localizer::Workspace::rotation_is_unknown() const {
  return place && !odometer.has_motion() && !rotation.rate_rad_s();
}

bool Localizer::Workspace::try_rotation_rates(const Scan& scan, TimeNs t_ns) {
  for (const double omega_rad_s : kTriedRates_rad_s) {
    look(scan, t_ns, Twist2{0, 0, omega_rad_s});
    refine_motion(scan, t_ns);
    if (is_half_explained()) return true;
  }
  look(scan, t_ns, memory.motion());
  return false;
}

void Localizer::Workspace::look_for_the_motion(const Scan& scan, TimeNs t_ns) {
  const auto is_likelier_at_rest = [&] {
    const BeamCounts moving = best_rays();
    if (moving.hits == 0) return true;
    const Pose2 T_map_lidar = place->place_search.exact()->refined.T_map_lidar;
    return explains_more(try_at(scan, t_ns, {}, T_map_lidar, place->bias.bias()).rays, moving);
  };
  if (!motion.is_rest() && is_likelier_at_rest()) look(scan, t_ns, {});
  refine_motion(scan, t_ns);
  // Nothing fits: the robot rotates, as the scan before shows; in the other direction where the
  // order of the bearings is not known.
  if (odometer.has_motion() || is_half_explained()) return;
  const std::optional<double> rate_rad_s = rotation.rate_rad_s();
  if (!rate_rad_s || std::abs(*rate_rad_s) < kTurning_rad_s) return;
  const ScanMotion motion_before = motion;
  for (const double omega_rad_s : {*rate_rad_s, -*rate_rad_s}) {
    const BeamCounts before = best_rays();
    if (is_half_explained() || (omega_rad_s != *rate_rad_s && knows_order())) return;
    look(scan, t_ns, Twist2{motion_before.twist.vx_m_s, motion_before.twist.vy_m_s, omega_rad_s});
    refine_motion(scan, t_ns);
    if (!explains_more(best_rays(), before)) look(scan, t_ns, motion_before);
  }
}

bool Localizer::Workspace::fits_as_it_came(const Scan& scan, TimeNs t_ns) {
  if (!place || candidates.empty()) return false;
  const BeamCounts there =
      try_at(scan, t_ns, {}, candidates.front().refined.T_map_lidar, place->bias.bias()).rays;
  return there.is_conclusive(/*expected=*/true) ||
         (place->map_error.is_exact() && there.hit_share() > kMovingHitShare);
}

Covariance3 Localizer::Workspace::deskew_covariance(const Pose2& T_map_lidar, bool is_first) {
  const Twist2 measured = memory.motion();
  // Neither a scan before nor walls that are known to be exact show that it stood.
  const bool may_drive = is_first && !place->map_error.is_exact();
  if (motion.is_rest() && measured.is_rest() && !may_drive) return Covariance3::Zero();
  const Eigen::Matrix3d error =
      place->refinement.error_per_velocity(*map, T_map_lidar, points.points(), noise_scale());
  Eigen::Vector3d sigma = velocity_sigma(motion.twist, measured);
  if (may_drive) sigma += Eigen::Vector3d(kDrives_m_s, kDrives_m_s, kDrives_rad_s);
  Covariance3 covariance = error * sigma.cwiseAbs2().asDiagonal() * error.transpose();
  covariance(2, 2) += squared(kUnsteady_s * (measured.omega_rad_s - motion.twist.omega_rad_s));
  return covariance;
}

}  // namespace cornerd::core
