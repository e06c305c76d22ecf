// SPDX-License-Identifier: MIT
#include "survey/loop_closure.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "core/geometry/linear_solve.hpp"
#include "survey/adjustment.hpp"
#include "survey/face_merging.hpp"
#include "survey/linearization.hpp"

namespace cornerd::survey {
namespace {

/// Largest drift, as a Mahalanobis distance (three degrees of freedom).
constexpr double kMaxSigmas = 20;
/// The robot may have returned up to this many scans before it was recognised.
constexpr std::size_t kReturnScans = 120;
/// Share of all observations that a loop closure may turn into outliers.
constexpr double kMoreOutliers = 0.005;
/// Largest residual of a loop constraint after the adjustment.
constexpr double kMaxOff_m = 0.1;
constexpr double kMaxOff_rad = core::radians(1.5);
/// Each trial adjusts the whole drive.
constexpr std::size_t kMaxLoops = 32;
constexpr std::size_t kMaxRefused = 8;

double mahalanobis_distance(const MappedDrive& drive, const LoopConstraint& constraint) {
  core::Covariance3 covariance =
      relative_pose_covariance(drive, constraint.earlier, constraint.later);
  covariance.diagonal() += Eigen::Vector3d(squared(constraint.sigma_m), squared(constraint.sigma_m),
                                           squared(constraint.sigma_rad));
  const RelativePoseResidual residual(drive.T_map_lidar[constraint.earlier],
                                      drive.T_map_lidar[constraint.later],
                                      constraint.T_earlier_later);
  const Eigen::Vector3d off(residual.off[0], residual.off[1], residual.off[2]);
  return std::sqrt(off.dot(core::SymmetricSolver<3>(covariance).solve(off)));
}

bool constraints_hold(const MappedDrive& drive, std::span<const LoopConstraint> loop_constraints) {
  return std::all_of(loop_constraints.begin(), loop_constraints.end(),
                     [&](const LoopConstraint& constraint) {
                       const RelativePoseResidual residual(drive.T_map_lidar[constraint.earlier],
                                                           drive.T_map_lidar[constraint.later],
                                                           constraint.T_earlier_later);
                       return std::hypot(residual.off[0], residual.off[1]) < kMaxOff_m &&
                              std::abs(residual.off[2]) < kMaxOff_rad;
                     });
}

/// Returns why the loop was rejected; empty where it was closed.
std::string try_to_close(MappedDrive& drive, const LoopCandidate& loop, const MergeLimits& merging,
                         std::size_t& merged) {
  // Since the return, the scan matching may have taken other walls for known ones.
  MappedDrive trial = drive;
  const std::size_t back = loop.loop_constraints.front().later;
  const std::size_t split = split_revisited(trial, back - std::min(back, kReturnScans), kMinLoop_m);
  const AdjustmentResult before = adjust(trial);
  const double sigmas =
      mahalanobis_distance(trial, loop.loop_constraints[loop.loop_constraints.size() / 2]);
  if (!(sigmas < kMaxSigmas)) return "the drift is larger than the drive's uncertainty allows";
  trial.loop_constraints.insert(trial.loop_constraints.end(), loop.loop_constraints.begin(),
                                loop.loop_constraints.end());
  adjust(trial);
  const std::size_t remerged = merge_faces(trial, {}, merging);
  const AdjustmentResult after = adjust(trial);
  if (!constraints_hold(trial, loop.loop_constraints))
    return "the walls in between contradict the loop";
  const double most = static_cast<double>(before.outliers) +
                      kMoreOutliers * static_cast<double>(drive.observations.size());
  if (static_cast<double>(after.outliers) > most)
    return "it makes too many wall observations outliers";
  merged += remerged - std::min(remerged, split);
  drive = std::move(trial);
  return {};
}

}  // namespace

std::vector<LoopReport> close_loops(MappedDrive& drive, const core::LocalizerConfig& sensor,
                                    const MergeLimits& merging, const WallLimits& walls,
                                    std::size_t& merged, const Progress& progress) {
  std::vector<LoopReport> reports;
  std::size_t refused = 0;
  for (std::size_t begin = 0; begin < drive.T_map_lidar.size(); begin += kSegmentScans) {
    if (progress) progress(begin);
    if (reports.size() >= kMaxLoops || refused >= kMaxRefused) break;
    const auto loop = find_loop(drive, begin, sensor, walls);
    if (!loop) continue;
    const LoopConstraint& middle = loop->loop_constraints[loop->loop_constraints.size() / 2];
    LoopReport report;
    report.earlier = middle.earlier;
    report.later = middle.later;
    report.agreeing = loop->loop_constraints.size();
    report.off_m = loop->T_now_then.translation().norm();
    report.off_rad = loop->T_now_then.theta_rad;
    report.refused = try_to_close(drive, *loop, merging, merged);
    refused += report.closed() ? 0 : 1;
    reports.push_back(report);
  }
  return reports;
}

}  // namespace cornerd::survey
