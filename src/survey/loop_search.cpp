// SPDX-License-Identifier: MIT
#include "survey/loop_search.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "core/localizer.hpp"
#include "core/recognition/hypothesis.hpp"

namespace cornerd::survey {
namespace {

/// Where a drive may have been in truth: within this, and a share of its way since.
constexpr double kNeighbourhood_m = 2;
constexpr double kDriftShare = 0.1;
/// Turns that the map of the neighbourhood is made of, at most.
constexpr std::size_t kMostEarlier = 240;
/// Of the samples on walls: what has to be on walls that were not seen before.
constexpr double kNewShare = 0.03;
/// Of a stretch every so many a index is asked; without any answer from the first of them no more.
constexpr std::size_t kAskEach = 5;
constexpr std::size_t kPatience = 4;
/// What places a index beyond doubt: so many of its corners, and so much of its returns.
constexpr std::size_t kLeastCorners = 3;
constexpr double kLeastExplained = 0.6;
/// Turns that have to agree, their share of all that were recognised, and the way between them.
constexpr std::size_t kLeastAgreeing = 4;
constexpr double kLeastAgreeingShare = 0.66;
constexpr double kLeastWayAgreed_m = 0.4;
/// How far two turns may disagree.
constexpr double kAgreement_m = 0.05;
constexpr double kAgreement_rad = core::radians(1.5);
/// Nearer, and the matching has done it, or will.
constexpr double kClosed_m = 0.03;
constexpr double kClosed_rad = core::radians(0.5);
/// Doubt of a tie. The turns of one loop err together, by what the map of the earlier ones does.
constexpr double kTieSigma_m = 0.03;
constexpr double kTieSigma_rad = core::radians(0.4);

struct RecognisedScan {
  std::uint32_t index = 0;
  core::Pose2 T_map_lidar;
};

/// Turns from long before that may have been near the stretch, ascending.
std::vector<std::uint32_t> neighbours_of(const MappedDrive& drive, std::size_t begin,
                                         std::size_t end) {
  const std::vector<double> ways = ways_m(drive);
  const core::Vec2 middle = drive.T_map_lidar[(begin + end) / 2].translation();
  std::vector<std::uint32_t> scans;
  for (std::size_t index = 0; index < begin && ways[begin] - ways[index] > kLeastLoop_m; ++index) {
    const double reach_m = kNeighbourhood_m + kDriftShare * (ways[begin] - ways[index]);
    if ((drive.T_map_lidar[index].translation() - middle).norm() > reach_m) continue;
    scans.push_back(static_cast<std::uint32_t>(index));
  }
  if (scans.size() <= kMostEarlier) return scans;
  std::vector<std::uint32_t> some;
  for (std::size_t i = 0; i < kMostEarlier; ++i) {
    some.push_back(scans[i * scans.size() / kMostEarlier]);
  }
  return some;
}

/// Of the samples that a stretch has on walls: those on walls that nobody had seen up to a index.
double new_share(const MappedDrive& drive, std::size_t begin, std::size_t end,
                 std::size_t known_until) {
  double all = 0;
  double on_new = 0;
  for (std::size_t index = begin; index < end; ++index) {
    for (const Observation& observation : drive.observations_of(index)) {
      all += observation.seen.support;
      if (drive.faces[observation.face].first_scan > known_until)
        on_new += observation.seen.support;
    }
  }
  return all > 0 ? on_new / all : 0;
}

/// The index as a lidar saw it that stood still.
void fill_scan(std::span<const StraightPoint> points, core::Scan& scan) {
  scan.clear();
  for (const StraightPoint& point : points) {
    core::Sample sample;
    sample.bearing_rad = point.bearing_rad;
    sample.range_m = point.range_m;
    scan.add(sample);
  }
}

core::LocalizerConfig config_of_recogniser(const core::LocalizerConfig& sensor) {
  core::LocalizerConfig config = sensor;
  config.T_base_lidar = {};
  config.bias = {};  // was taken off
  config.learn_bias = false;
  config.odometry.enabled = false;
  config.updates_per_scan = 1;
  return config;
}

class Recogniser {
 public:
  Recogniser(const MappedDrive& drive, std::shared_ptr<const core::WallMap> map,
             const core::LocalizerConfig& sensor)
      : drive_(drive), localizer_(std::move(map), config_of_recogniser(sensor)) {}

  std::optional<RecognisedScan> ask(std::size_t index) {
    const auto points = drive_.points_of(index);
    fill_scan(points, scan_);
    localizer_.relocalize();
    const core::PoseEstimate& pose = localizer_.step(scan_).pose;
    if (pose.state != core::PoseState::kFix || pose.corners < kLeastCorners) return std::nullopt;
    if (static_cast<double>(pose.inliers) < kLeastExplained * static_cast<double>(points.size())) {
      return std::nullopt;
    }
    return RecognisedScan{static_cast<std::uint32_t>(index), pose.T_map_base};
  }

 private:
  const MappedDrive& drive_;
  core::Localizer localizer_;
  core::Scan scan_;
};

/// The most turns that agree on where the stretch is.
std::vector<RecognisedScan> agreeing(const MappedDrive& drive,
                                     std::span<const RecognisedScan> scans) {
  std::vector<RecognisedScan> best;
  for (const RecognisedScan& one : scans) {
    const core::Pose2 T_then_now = one.T_map_lidar * drive.T_map_lidar[one.index].inverse();
    std::vector<RecognisedScan> same;
    for (const RecognisedScan& other : scans) {
      const core::Pose2 expected = T_then_now * drive.T_map_lidar[other.index];
      if (core::same_place(expected, other.T_map_lidar, kAgreement_m, kAgreement_rad)) {
        same.push_back(other);
      }
    }
    if (same.size() > best.size()) best.swap(same);
  }
  return best;
}

bool is_enough(const MappedDrive& drive, std::span<const RecognisedScan> agreed,
               std::size_t recognised) {
  if (agreed.size() < kLeastAgreeing) return false;
  if (static_cast<double>(agreed.size()) < kLeastAgreeingShare * static_cast<double>(recognised)) {
    return false;
  }
  double farthest_m = 0;
  const core::Vec2 first = drive.T_map_lidar[agreed.front().index].translation();
  for (const RecognisedScan& one : agreed) {
    farthest_m = std::max(farthest_m, (drive.T_map_lidar[one.index].translation() - first).norm());
  }
  return farthest_m > kLeastWayAgreed_m;
}

PlaceTie tie_of(const MappedDrive& drive, std::span<const std::uint32_t> earlier,
                const RecognisedScan& recognised) {
  const core::Vec2 place = recognised.T_map_lidar.translation();
  const auto distance = [&](std::uint32_t index) {
    return (drive.T_map_lidar[index].translation() - place).squaredNorm();
  };
  PlaceTie tie;
  tie.earlier = *std::min_element(
      earlier.begin(), earlier.end(),
      [&](std::uint32_t a, std::uint32_t b) { return distance(a) < distance(b); });
  tie.later = recognised.index;
  tie.T_earlier_later = drive.T_map_lidar[tie.earlier].inverse() * recognised.T_map_lidar;
  tie.sigma_m = kTieSigma_m;
  tie.sigma_rad = kTieSigma_rad;
  return tie;
}

}  // namespace

std::optional<Loop> find_loop(const MappedDrive& drive, std::size_t begin,
                              const core::LocalizerConfig& sensor, const WallLimits& limits) {
  const std::size_t end = std::min(begin + kStretchScans, drive.T_map_lidar.size());
  const std::vector<std::uint32_t> earlier = neighbours_of(drive, begin, end);
  if (earlier.empty() || new_share(drive, begin, end, earlier.back()) < kNewShare) {
    return std::nullopt;
  }
  const auto map = map_seen_by(drive, earlier, sensor.noise, limits);
  if (!map) return std::nullopt;

  Loop loop;
  Recogniser recogniser(drive, map, sensor);
  std::vector<RecognisedScan> recognised;
  for (std::size_t index = begin; index < end; index += kAskEach) {
    if (loop.asked == kPatience && recognised.empty()) return std::nullopt;
    ++loop.asked;
    if (const auto found = recogniser.ask(index)) recognised.push_back(*found);
  }
  loop.recognised = recognised.size();
  const std::vector<RecognisedScan> agreed = agreeing(drive, recognised);
  if (!is_enough(drive, agreed, recognised.size())) return std::nullopt;
  const RecognisedScan& middle = agreed[agreed.size() / 2];
  loop.T_now_then = drive.T_map_lidar[middle.index].inverse() * middle.T_map_lidar;
  if (core::same_place({}, loop.T_now_then, kClosed_m, kClosed_rad)) return std::nullopt;
  for (const RecognisedScan& one : agreed) loop.ties.push_back(tie_of(drive, earlier, one));
  return loop;
}

}  // namespace cornerd::survey
