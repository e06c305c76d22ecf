// SPDX-License-Identifier: MIT
#include "bench/paper_experiment.hpp"

#include <algorithm>

#include "bench/nearest_corners.hpp"
#include "bench/scoring.hpp"
#include "bench/workload.hpp"
#include "core/localizer.hpp"
#include "replay/simulator/scan_simulator.hpp"

namespace cornerd::bench {
namespace {

using core::BreakpointKind;

double distance_m(const core::Pose2& a, const core::Pose2& b) {
  return (a.translation() - b.translation()).norm();
}

/// The true corners visible in each scan.
class ScanTruths {
 public:
  explicit ScanTruths(const PaperScans& scans) : scans_(scans) {
    for (const auto& map : scans.maps) truths_.emplace_back(*map, limits_.max_range_m);
  }

  const replay::CornerTruth& at(std::size_t scan) {
    const PaperPose& place = scans_.poses[scan];
    points_.assign(scans_.scans[scan], limits_.min_range_m, limits_.max_range_m);
    truths_[place.map].observe(place.T_map_lidar, points_.points());
    return truths_[place.map];
  }

 private:
  const core::LocalizerConfig limits_;
  const PaperScans& scans_;
  std::vector<replay::CornerTruth> truths_;
  core::PolarScan points_;
};

/// The localizer's pose, each scan independent.
std::optional<core::Pose2> localize(core::Localizer& localizer, const core::Scan& scan) {
  localizer.forget();
  const core::PoseEstimate& pose = localizer.step(scan).pose;
  if (pose.state != core::PoseState::kFix) return std::nullopt;
  return pose.T_map_base;
}

PaperResult run_method(const PaperScans& scans, const NamedMethod& method,
                       std::size_t timing_repeats) {
  core::LocalizerConfig config;
  config.detector = method.config;
  std::vector<core::Localizer> localizers;
  for (const auto& map : scans.maps) localizers.emplace_back(map, config);
  Workload workload(method, scans.scans);
  ScanTruths truth(scans);

  PaperResult result{method, std::vector<PoseResult>(scans.poses.size())};
  for (std::size_t i = 0; i < scans.poses.size(); ++i) {
    PoseResult& at = result.poses[i];
    const PaperPose& place = scans.poses[i];
    workload.run(i);
    at.breakpoints = workload.detection().breakpoints;

    CornerScore score;
    score.add(at.breakpoints, truth.at(i));
    at.true_corners = score.detections(BreakpointKind::kCorner, Verdict::kTrue);
    at.missed_corners = score.missed();
    at.false_corners = score.detections(BreakpointKind::kCorner, Verdict::kFalse) +
                       score.detections(BreakpointKind::kCorner, Verdict::kOneSided);

    const auto error_m = [&](const std::optional<core::Pose2>& found) -> std::optional<double> {
      if (!found) return std::nullopt;
      return distance_m(*found, place.T_map_lidar);
    };
    at.nearest_corners_error_m = error_m(
        pose_from_nearest_corners(at.breakpoints, *scans.maps[place.map], place.T_map_lidar));
    at.localizer_error_m = error_m(localize(localizers[place.map], scans.scans[i]));
  }
  if (timing_repeats > 0) {
    const std::vector<double> times_us = time_scans_us(workload, timing_repeats);
    for (std::size_t i = 0; i < times_us.size(); ++i) result.poses[i].time_us = times_us[i];
  }
  return result;
}

}  // namespace

PaperScans simulate_paper_scans(std::span<const std::shared_ptr<const core::WallMap>> maps,
                                const replay::SensorModel& sensor, std::size_t samples,
                                std::uint64_t seed) {
  PaperScans result{{maps.begin(), maps.end()}, paper_poses(maps), {}};
  replay::ScanSimulator simulator(sensor, samples, seed);
  for (const PaperPose& place : result.poses) {
    result.scans.push_back(simulator.take(*maps[place.map], place.T_map_lidar));
  }
  return result;
}

std::vector<PaperResult> run_paper_experiment(const PaperScans& scans,
                                              std::span<const NamedMethod> methods,
                                              std::size_t timing_repeats) {
  std::vector<PaperResult> results;
  for (const NamedMethod& method : methods) {
    results.push_back(run_method(scans, method, timing_repeats));
  }
  return results;
}

std::vector<std::size_t> supported_corners(const PaperScans& scans) {
  ScanTruths truth(scans);
  std::vector<std::size_t> counts;
  for (std::size_t i = 0; i < scans.scans.size(); ++i) {
    const auto corners = truth.at(i).corners();
    counts.push_back(static_cast<std::size_t>(
        std::count_if(corners.begin(), corners.end(), [](const replay::CornerObservation& corner) {
          return corner.view == replay::CornerView::kSupported;
        })));
  }
  return counts;
}

}  // namespace cornerd::bench
