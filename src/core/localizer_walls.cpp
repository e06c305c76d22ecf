// SPDX-License-Identifier: MIT
// Poses by walls whose offsets from the map are learned.
#include <algorithm>

#include "core/localizer_workspace.hpp"

namespace cornerd::core {
namespace {

/// The walls' offsets move a pose by this much at most; the rest is another place.
constexpr double kMaxMove_m = 0.1;
constexpr double kMaxMove_rad = radians(3);
/// Error of a pose that was refined without the learned offsets.
constexpr double kLearnedRadius_m = 0.02;
/// Scans from one place err together: the next one counts after a motion of this much.
constexpr double kNextPlace_m = 0.1;
constexpr double kNextPlace_rad = radians(10);
/// Scans that are less certain than this or worse explained teach nothing: reduced
/// chi-square, which a motion raises; share of the points on walls; pose.
constexpr double kMaxSpread = 1.4;
constexpr double kMinShare = 0.5;
constexpr double kMaxSigma_m = 0.05;
/// Scans in a row that named the place where the last one led to expect it: 1.4 s.
constexpr std::size_t kMinNamed = 10;
/// Places whose scans the map explains and what was learned does not, until walls count as moved: a
/// cupboard was taken away. In 24 drives through drawn plans (src/bench/maps.md) 5 in a row
/// happened, 20 did not.
constexpr std::size_t kUntilMoved = 20;

bool is_explained(const RefinedPose& refined) {
  return refined.valid && refined.reduced_chi_square < kMaxSpread;
}

}  // namespace

const WallOffsetFilter* Localizer::walls() const {
  return workspace_->place && workspace_->place->walls ? &*workspace_->place->walls : nullptr;
}

const WallMap* Localizer::map() const { return workspace_->map.get(); }

std::span<const MapChange> Localizer::map_changes() const {
  if (walls() == nullptr) return {};
  return workspace_->place->changes->changes();
}

bool Localizer::resume(const LearnedWalls& learned, std::span<const MapChange> changes) {
  if (walls() == nullptr || !workspace_->place->walls->resume(learned)) return false;
  workspace_->place->changes->resume(changes);
  return true;
}

bool Localizer::Workspace::is_map_inexact() const { return map && map->plan().is_inexact(); }

/// Walls that are off by centimetres look like a motion of centimetres a scan.
bool Localizer::Workspace::trusts_odometry() const {
  return odometer.has_motion() && is_map_inexact();
}

bool Localizer::Workspace::Place::learns_walls(const FloorPlan& plan) {
  return plan.is_inexact() ||
         std::any_of(plan.walls.begin(), plan.walls.end(),
                     [](const Wall& wall) { return wall.sigma_m.has_value(); });
}

bool Localizer::Workspace::is_certain(const RefinedPose& refined) const {
  const double on_walls = static_cast<double>(refined.inliers);
  const double variance_m2 = refined.covariance(0, 0) + refined.covariance(1, 1);
  return named_in_a_row >= kMinNamed && on_walls > kMinShare * static_cast<double>(points.size()) &&
         variance_m2 < kMaxSigma_m * kMaxSigma_m;
}

double Localizer::Workspace::map_sigma_m(const VerifiedHypothesis& found) const {
  const bool is_off = !place->map_error.is_exact() && found.refined.face_residuals.shows_offsets();
  return is_map_inexact() || is_off ? std::max(found.map_sigma_m, map->plan().sigma_m)
                                    : found.map_sigma_m;
}

RefinedPose Localizer::Workspace::refine_by(WallOffsetFilter* walls,
                                            const VerifiedHypothesis& found) {
  RefinedPose refined =
      place->refinement.refine(*map, found.refined.T_map_lidar, kLearnedRadius_m, points.points(),
                               points.points(), noise_scale(), map_sigma_m(found), nullptr, walls);
  refined.valid = refined.valid && same_pose(refined.T_map_lidar, found.refined.T_map_lidar,
                                             kMaxMove_m, kMaxMove_rad);
  return refined;
}

RefinedPose Localizer::Workspace::with_directions(const RefinedPose& parallel,
                                                  const VerifiedHypothesis& found,
                                                  WallOffsetFilter* walls) {
  if (!parallel.shows_directions()) return parallel;
  const RefinedPose refined = place->refinement.refine_directions(
      *map, parallel, points.points(), noise_scale(), map_sigma_m(found), walls);
  if (!refined.valid ||
      !same_pose(refined.T_map_lidar, parallel.T_map_lidar, kMaxMove_m, kMaxMove_rad)) {
    // The filter holds the scan as it was refined last.
    return walls == nullptr ? parallel : refine_by(walls, found);
  }
  if (odometer.has_motion()) return refined;
  // A motion that nobody measured makes walls look turned: the pose stays, and its covariance holds
  // both.
  const Eigen::Vector3d apart(
      refined.T_map_lidar.x_m - parallel.T_map_lidar.x_m,
      refined.T_map_lidar.y_m - parallel.T_map_lidar.y_m,
      angle_between(parallel.T_map_lidar.theta_rad, refined.T_map_lidar.theta_rad));
  RefinedPose either = parallel;
  either.covariance = refined.covariance + apart * apart.transpose();
  return either;
}

void Localizer::Workspace::teach_walls(const RefinedPose& refined,
                                       const VerifiedHypothesis& found) {
  const auto is_same_place = [&](const std::optional<Pose2>& T_map_before) {
    return T_map_before &&
           same_pose(*T_map_before, refined.T_map_lidar, kNextPlace_m, kNextPlace_rad);
  };
  WallOffsetFilter& walls = *place->walls;
  if (is_explained(refined)) {
    if (is_same_place(T_map_taught)) return;
    if (walls.learn(refined.nominal_covariance())) contradictions = 0;
    T_map_taught = refined.T_map_lidar;
  } else if (walls.size() > 0 && !is_same_place(T_map_against) &&
             is_explained(refine_by(nullptr, found))) {
    T_map_against = refined.T_map_lidar;
    if (++contradictions == kUntilMoved) {
      walls.forget_visible();
      contradictions = 0;
    }
  }
}

RefinedPose Localizer::Workspace::refined_by_walls(const VerifiedHypothesis& found, TimeNs t_ns) {
  const bool is_next = prior_is_fresh(t_ns) && is_expected(found.refined.T_map_lidar, t_ns);
  named_in_a_row = is_next ? named_in_a_row + 1 : 0;
  const auto by_map = [&] {
    // A scan may fit a wrong map exactly: the map knows better how far off it is.
    if (map_sigma_m(found) == found.map_sigma_m) return with_directions(found.refined, found);
    const RefinedPose refined = refine_by(nullptr, found);
    return with_directions(refined.valid ? refined : found.refined, found);
  };
  if (!place->walls) return by_map();
  RefinedPose refined = refine_by(&*place->walls, found);
  if (!refined.valid) return by_map();
  // A motion that nobody measured turns walls: nothing is learned of that.
  if (odometer.has_motion()) refined = with_directions(refined, found, &*place->walls);
  const bool is_learned = place->walls->size() > 0;
  if (is_certain(refined)) {
    if (is_explained(refined)) {
      place->changes->add(*map, refined.T_map_lidar, points.points(), map->plan().sigma_m, t_ns);
    }
    teach_walls(refined, found);
  }
  // Ends of walls tell something of a pose too, though nothing of the walls.
  if (!is_learned) return by_map();
  refined.face_residuals = found.refined.face_residuals;
  return odometer.has_motion() ? refined : with_directions(refined, found, &*place->walls);
}

}  // namespace cornerd::core
