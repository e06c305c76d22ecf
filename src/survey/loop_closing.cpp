// SPDX-License-Identifier: MIT
#include "survey/loop_closing.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "core/geometry/linear_solve.hpp"
#include "survey/adjustment.hpp"
#include "survey/face_splitting.hpp"
#include "survey/linearization.hpp"

namespace cornerd::survey {
namespace {

/// How far a drive may be off where it comes back, in sigmas of what it knows of the way.
constexpr double kMostSigmas = 20;
/// A robot is back this many turns before it is recognised, at most.
constexpr std::size_t kReturnTurns = 120;
/// Observations that a loop may make outliers, as a share of all.
constexpr double kMoreOutliers = 0.005;
/// After the adjustment every turn has to be where it was recognised.
constexpr double kTied_m = 0.1;
constexpr double kTied_rad = core::radians(1.5);
/// Each try adjusts the whole drive: so many are made, and fewer where they lead to nothing.
constexpr std::size_t kMostLoops = 32;
constexpr std::size_t kMostRefused = 8;

double sigmas_off(const MappedDrive& drive, const PlaceTie& tie) {
  core::Covariance3 covariance = covariance_of_way(drive, tie.earlier, tie.later);
  covariance.diagonal() +=
      Eigen::Vector3d(squared(tie.sigma_m), squared(tie.sigma_m), squared(tie.sigma_rad));
  const WayResidual way(drive.T_map_lidar[tie.earlier], drive.T_map_lidar[tie.later],
                        tie.T_earlier_later);
  const Eigen::Vector3d off(way.off[0], way.off[1], way.off[2]);
  return std::sqrt(off.dot(core::SymmetricSolver<3>(covariance).solve(off)));
}

bool are_tied(const MappedDrive& drive, std::span<const PlaceTie> ties) {
  return std::all_of(ties.begin(), ties.end(), [&](const PlaceTie& tie) {
    const WayResidual way(drive.T_map_lidar[tie.earlier], drive.T_map_lidar[tie.later],
                          tie.T_earlier_later);
    return std::hypot(way.off[0], way.off[1]) < kTied_m && std::abs(way.off[2]) < kTied_rad;
  });
}

/// Why the loop is not to be closed; empty where it was.
std::string try_to_close(MappedDrive& drive, const Loop& loop, const MergeLimits& merging,
                         std::size_t& merged) {
  // What is seen since the robot came back may have been taken for other walls.
  MappedDrive trial = drive;
  const std::size_t back = loop.ties.front().later;
  const std::size_t split =
      split_revisited(trial, back - std::min(back, kReturnTurns), kLeastLoop_m);
  const AdjustmentResult before = adjust(trial);
  const double sigmas = sigmas_off(trial, loop.ties[loop.ties.size() / 2]);
  if (!(sigmas < kMostSigmas)) return "farther off than the drive can be";
  trial.ties.insert(trial.ties.end(), loop.ties.begin(), loop.ties.end());
  adjust(trial);
  const std::size_t remerged = merge_faces(trial, {}, merging);
  const AdjustmentResult after = adjust(trial);
  if (!are_tied(trial, loop.ties)) return "the walls seen in between hold it apart";
  const double most = static_cast<double>(before.outliers) +
                      kMoreOutliers * static_cast<double>(drive.observations.size());
  if (static_cast<double>(after.outliers) > most) return "the walls seen in between contradict";
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
  for (std::size_t begin = 0; begin < drive.T_map_lidar.size(); begin += kStretchScans) {
    if (progress) progress(begin);
    if (reports.size() >= kMostLoops || refused >= kMostRefused) break;
    const auto loop = find_loop(drive, begin, sensor, walls);
    if (!loop) continue;
    const PlaceTie& middle = loop->ties[loop->ties.size() / 2];
    LoopReport report;
    report.earlier = middle.earlier;
    report.later = middle.later;
    report.agreeing = loop->ties.size();
    report.off_m = loop->T_now_then.translation().norm();
    report.off_rad = loop->T_now_then.theta_rad;
    report.refused = try_to_close(drive, *loop, merging, merged);
    refused += report.closed() ? 0 : 1;
    reports.push_back(report);
  }
  return reports;
}

}  // namespace cornerd::survey
