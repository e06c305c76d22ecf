// SPDX-License-Identifier: MIT
#include "survey/loop_detection.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>
#include <vector>

#include "core/localizer.hpp"
#include "core/recognition/hypothesis.hpp"
#include "survey/face_evidence.hpp"

namespace cornerd::survey {
namespace {

/// Search radius for earlier scans: this, plus a share of the distance travelled since.
constexpr double kNeighbourhood_m = 2;
constexpr double kDriftShare = 0.1;
/// Scans that the map is made of, at most.
constexpr std::size_t kMaxEarlier = 240;
/// Share of the samples on lines that must be on faces not observed before.
constexpr double kNewShare = 0.03;
/// One scan in kScanStride is tried; none after kMaxFailedTries without a fix.
constexpr std::size_t kScanStride = 5;
constexpr std::size_t kMaxFailedTries = 4;
/// Smallest number of corners and share of explained returns of an unambiguous fix.
constexpr std::size_t kMinCorners = 3;
constexpr double kMinExplained = 0.6;
/// Scans that have to agree, their share of those localized, and the distance between them.
constexpr std::size_t kMinAgreeing = 4;
constexpr double kMinAgreeingShare = 0.66;
constexpr double kMinAgreedDistance_m = 0.4;
/// Largest difference between two scans that agree.
constexpr double kMaxDisagreement_m = 0.05;
constexpr double kMaxDisagreement_rad = core::radians(1.5);
/// A smaller drift is left to scan matching.
constexpr double kClosed_m = 0.03;
constexpr double kClosed_rad = core::radians(0.5);
/// Sigma of a loop constraint. The scans of one loop share the error of the map.
constexpr double kTieSigma_m = 0.03;
constexpr double kTieSigma_rad = core::radians(0.4);

struct RecognisedScan {
  std::uint32_t index = 0;
  core::Pose2 T_map_lidar;
};

/// Earlier scans that may have been near the segment, ascending.
std::vector<std::uint32_t> neighbours_of(const MappedDrive& drive, std::size_t begin,
                                         std::size_t end) {
  const std::vector<double> travelled = travelled_m(drive);
  const core::Vec2 middle = drive.T_map_lidar[(begin + end) / 2].translation();
  std::vector<std::uint32_t> scans;
  for (std::size_t index = 0; index < begin && travelled[begin] - travelled[index] > kMinLoop_m;
       ++index) {
    const double reach_m = kNeighbourhood_m + kDriftShare * (travelled[begin] - travelled[index]);
    if ((drive.T_map_lidar[index].translation() - middle).norm() > reach_m) continue;
    scans.push_back(static_cast<std::uint32_t>(index));
  }
  if (scans.size() <= kMaxEarlier) return scans;
  std::vector<std::uint32_t> some;
  for (std::size_t i = 0; i < kMaxEarlier; ++i) {
    some.push_back(scans[i * scans.size() / kMaxEarlier]);
  }
  return some;
}

/// Share of a segment's samples on lines that are on faces first observed after `known_until`.
double new_share(const MappedDrive& drive, std::size_t begin, std::size_t end,
                 std::size_t known_until) {
  double all = 0;
  double on_new = 0;
  for (std::size_t index = begin; index < end; ++index) {
    for (const MatchedObservation& observation : drive.observations_of(index)) {
      all += observation.seen.support;
      if (drive.faces[observation.face].first_scan > known_until)
        on_new += observation.seen.support;
    }
  }
  return all > 0 ? on_new / all : 0;
}

/// A deskewed scan.
void fill_scan(std::span<const DeskewedPoint> points, core::Scan& scan) {
  scan.clear();
  for (const DeskewedPoint& point : points) {
    core::Sample sample;
    sample.bearing_rad = point.bearing_rad;
    sample.range_m = point.range_m;
    scan.add(sample);
  }
}

core::LocalizerConfig config_of_recogniser(const core::LocalizerConfig& sensor) {
  core::LocalizerConfig config = sensor;
  config.T_base_lidar = {};
  config.bias = {};  // corrected already
  config.calibrate_online = false;
  config.odometry.enabled = false;
  config.updates_per_scan = 1;
  return config;
}

class Recogniser {
 public:
  Recogniser(const MappedDrive& drive, std::shared_ptr<const core::WallMap> map,
             const core::LocalizerConfig& sensor)
      : drive_(drive), localizer_(std::move(map), config_of_recogniser(sensor)) {}

  std::optional<RecognisedScan> localize(std::size_t index) {
    const auto points = drive_.points_of(index);
    fill_scan(points, scan_);
    localizer_.relocalize();
    const core::PoseEstimate& pose = localizer_.step(scan_).pose;
    if (pose.state != core::PoseState::kFix || pose.corners < kMinCorners) return std::nullopt;
    if (static_cast<double>(pose.inliers) < kMinExplained * static_cast<double>(points.size())) {
      return std::nullopt;
    }
    return RecognisedScan{static_cast<std::uint32_t>(index), pose.T_map_base};
  }

 private:
  const MappedDrive& drive_;
  core::Localizer localizer_;
  core::Scan scan_;
};

/// The largest set of scans that agree on the segment's pose.
std::vector<RecognisedScan> agreeing(const MappedDrive& drive,
                                     std::span<const RecognisedScan> scans) {
  std::vector<RecognisedScan> best;
  for (const RecognisedScan& one : scans) {
    const core::Pose2 T_then_now = one.T_map_lidar * drive.T_map_lidar[one.index].inverse();
    std::vector<RecognisedScan> same;
    for (const RecognisedScan& other : scans) {
      const core::Pose2 expected = T_then_now * drive.T_map_lidar[other.index];
      if (core::same_pose(expected, other.T_map_lidar, kMaxDisagreement_m, kMaxDisagreement_rad)) {
        same.push_back(other);
      }
    }
    if (same.size() > best.size()) best.swap(same);
  }
  return best;
}

bool is_enough(const MappedDrive& drive, std::span<const RecognisedScan> agreed,
               std::size_t recognised) {
  if (agreed.size() < kMinAgreeing) return false;
  if (static_cast<double>(agreed.size()) < kMinAgreeingShare * static_cast<double>(recognised)) {
    return false;
  }
  double farthest_m = 0;
  const core::Vec2 first = drive.T_map_lidar[agreed.front().index].translation();
  for (const RecognisedScan& one : agreed) {
    farthest_m = std::max(farthest_m, (drive.T_map_lidar[one.index].translation() - first).norm());
  }
  return farthest_m > kMinAgreedDistance_m;
}

LoopConstraint tie_of(const MappedDrive& drive, std::span<const std::uint32_t> earlier,
                      const RecognisedScan& recognised) {
  const core::Vec2 place = recognised.T_map_lidar.translation();
  const auto distance = [&](std::uint32_t index) {
    return (drive.T_map_lidar[index].translation() - place).squaredNorm();
  };
  LoopConstraint constraint;
  constraint.earlier = *std::min_element(
      earlier.begin(), earlier.end(),
      [&](std::uint32_t a, std::uint32_t b) { return distance(a) < distance(b); });
  constraint.later = recognised.index;
  constraint.T_earlier_later =
      drive.T_map_lidar[constraint.earlier].inverse() * recognised.T_map_lidar;
  constraint.sigma_m = kTieSigma_m;
  constraint.sigma_rad = kTieSigma_rad;
  return constraint;
}

}  // namespace

std::optional<LoopCandidate> find_loop(const MappedDrive& drive, std::size_t begin,
                                       const core::LocalizerConfig& sensor,
                                       const WallLimits& limits) {
  const std::size_t end = std::min(begin + kSegmentScans, drive.T_map_lidar.size());
  const std::vector<std::uint32_t> earlier = neighbours_of(drive, begin, end);
  if (earlier.empty() || new_share(drive, begin, end, earlier.back()) < kNewShare) {
    return std::nullopt;
  }
  const auto map = map_from_scans(drive, earlier, sensor.noise, limits);
  if (!map) return std::nullopt;

  LoopCandidate loop;
  Recogniser recogniser(drive, map, sensor);
  std::vector<RecognisedScan> recognised;
  for (std::size_t index = begin; index < end; index += kScanStride) {
    if (loop.tried == kMaxFailedTries && recognised.empty()) return std::nullopt;
    ++loop.tried;
    if (const auto found = recogniser.localize(index)) recognised.push_back(*found);
  }
  loop.recognised = recognised.size();
  const std::vector<RecognisedScan> agreed = agreeing(drive, recognised);
  if (!is_enough(drive, agreed, recognised.size())) return std::nullopt;
  const RecognisedScan& middle = agreed[agreed.size() / 2];
  loop.T_now_then = drive.T_map_lidar[middle.index].inverse() * middle.T_map_lidar;
  if (core::same_pose({}, loop.T_now_then, kClosed_m, kClosed_rad)) return std::nullopt;
  for (const RecognisedScan& one : agreed)
    loop.loop_constraints.push_back(tie_of(drive, earlier, one));
  return loop;
}

MappedDrive subset_of(const MappedDrive& drive, std::span<const std::uint32_t> scans) {
  MappedDrive part;
  part.has_odometry = drive.has_odometry;
  part.first_point.push_back(0);
  std::vector<std::uint32_t> place_of(drive.faces.size(), kNoFace);
  for (const std::uint32_t scan : scans) {
    const auto number = static_cast<std::uint32_t>(part.T_map_lidar.size());
    part.T_map_lidar.push_back(drive.T_map_lidar[scan]);
    const auto points = drive.points_of(scan);
    part.points.insert(part.points.end(), points.begin(), points.end());
    part.first_point.push_back(part.points.size());
    for (MatchedObservation observation : drive.observations_of(scan)) {
      std::uint32_t& place = place_of[observation.face];
      if (place == kNoFace) {
        place = static_cast<std::uint32_t>(part.faces.size());
        part.faces.push_back(drive.faces[observation.face]);
      }
      observation.scan = number;
      observation.face = place;
      part.observations.push_back(observation);
    }
  }
  measure_faces(part);
  return part;
}

std::shared_ptr<const core::WallMap> map_from_scans(const MappedDrive& drive,
                                                    std::span<const std::uint32_t> scans,
                                                    const core::SensorNoise& noise,
                                                    const WallLimits& limits) {
  const MappedDrive part = subset_of(drive, scans);
  const std::vector<FaceEvidence> evidence = gather_evidence(part, noise, {});
  std::vector<DroppedPiece> dropped;
  core::FloorPlan plan;
  plan.walls = build_walls_of(part, evidence, limits, dropped).walls;
  if (plan.walls.empty()) return nullptr;
  return std::make_shared<const core::WallMap>(std::move(plan));
}

}  // namespace cornerd::survey
