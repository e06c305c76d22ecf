// SPDX-License-Identifier: MIT
#include "calibration/map_faults.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <memory>
#include <stdexcept>

#include "core/localizer.hpp"

namespace cornerd::calibration {
namespace {

/// Metres of units that drawings are in.
constexpr double kUnits[] = {0.001, 0.01, 0.0254, 0.3048};
/// Scales tried, in steps within which scans still have poses (README.md of this folder).
constexpr double kScaleStep = 0.015;
constexpr int kScaleSteps = 20;
/// A scan fits by its share of returns on walls, less the more they scatter: half as well at this.
/// A map 3 % off still gives four of five scans a pose, each for itself, but returns that scatter
/// by 5 cm.
constexpr double kScatter_m = 0.02;
/// A variant must fit so well, and so much better than the map itself.
constexpr double kFits = 0.4;
constexpr double kGain = 0.2;
/// A variant in which none of so many scans has a pose is given up: lost scans cost the most.
constexpr double kFirstScans = 4;
/// A lidar's ranges may be off by as much.
constexpr double kMaxLidarScale = 0.03;

core::FloorPlan mirrored(core::FloorPlan plan) {
  for (core::Wall& wall : plan.walls) {
    wall.from.y() = -wall.from.y();
    wall.to.y() = -wall.to.y();
  }
  plan.rooms.clear();
  return plan;
}

/// `scale`: along x and y.
core::FloorPlan scaled(core::FloorPlan plan, const core::Vec2& scale) {
  for (core::Wall& wall : plan.walls) {
    wall.from = wall.from.cwiseProduct(scale);
    wall.to = wall.to.cwiseProduct(scale);
    wall.thickness_m *= std::sqrt(scale.prod());
  }
  plan.rooms.clear();
  return plan;
}

core::Vec2 exp_of(const core::Vec2& logarithms) { return logarithms.array().exp(); }

class MapTrials {
 public:
  MapTrials(const core::LocalizerConfig& config, std::span<const ScanSamples> scans,
            const std::function<bool()>& is_over)
      : config_(config), scans_(scans), is_over_(is_over) {
    config_.odometry.enabled = false;
    config_.calibrate_online = false;
    config_.updates_per_scan = 1;
    config_.search_nodes_per_scan = core::kWholeSearch;  // each scan for itself
  }

  bool is_over() const { return is_over_(); }

  /// How well the scans fit, 0 to 1; 0 where it cannot exceed `least`, or the first have no pose.
  double fit(const core::FloorPlan& plan, double least) const {
    std::shared_ptr<const core::WallMap> map;
    try {
      map = std::make_shared<const core::WallMap>(plan);
    } catch (const std::invalid_argument&) {
      return 0;  // of a scale at which it is none
    }
    core::Localizer localizer(map, config_);
    core::Scan scan;
    const auto count = static_cast<double>(scans_.size());
    double sum = 0;
    double left = count;
    for (const ScanSamples& samples : scans_) {
      const bool begins_badly = sum == 0 && count - left >= kFirstScans;
      if (begins_badly || sum + left <= least * count || is_over_()) return 0;
      scan.clear();
      for (const core::Sample& sample : samples) scan.add(sample);
      localizer.relocalize();
      const core::PoseEstimate& pose = localizer.step(scan).pose;
      if (pose.state == core::PoseState::kFix) sum += fit_of(pose, samples);
      --left;
    }
    return sum / count;
  }

 private:
  static double fit_of(const core::PoseEstimate& pose, const ScanSamples& samples) {
    const auto returns = std::count_if(samples.begin(), samples.end(),
                                       [](const core::Sample& one) { return one.range_m > 0; });
    return static_cast<double>(pose.inliers) / static_cast<double>(std::max<long>(1, returns)) *
           kScatter_m / std::hypot(kScatter_m, pose.rmse_m);
  }

  core::LocalizerConfig config_;
  std::span<const ScanSamples> scans_;
  const std::function<bool()>& is_over_;
};

/// Of the axes that are 1 in `axes`; nullopt where the scans fit none better than `most`, which it
/// raises.
std::optional<core::Vec2> fitting_scale(const MapTrials& trials, const core::FloorPlan& plan,
                                        const core::Vec2& axes, double& most) {
  // Several scales fit: the true one is in their middle.
  double weights = 0;
  double sum = 0;
  double largest = most;
  for (int step = -kScaleSteps; step <= kScaleSteps && !trials.is_over(); ++step) {
    if (step == 0) continue;
    const double logarithm = step * std::log1p(kScaleStep);
    const double share = trials.fit(scaled(plan, exp_of(logarithm * axes)), most);
    weights += share;
    sum += share * logarithm;
    largest = std::max(largest, share);
  }
  if (weights == 0) return std::nullopt;
  most = largest;
  return exp_of(sum / weights * axes);
}

}  // namespace

std::optional<MapFinding> find_map_fault(const core::FloorPlan& plan,
                                         std::span<const core::FloorPlan> others,
                                         const core::LocalizerConfig& config,
                                         std::span<const ScanSamples> scans,
                                         const std::function<bool()>& is_over) {
  if (scans.empty()) return std::nullopt;
  const MapTrials trials(config, scans, is_over);
  const double as_it_is = trials.fit(plan, 0);
  if (as_it_is > 1 - kGain) return std::nullopt;
  MapFinding best;
  double most = std::max(kFits, as_it_is + kGain);
  const auto consider = [&](const core::FloorPlan& variant, const MapFinding& finding) {
    const double share = trials.fit(variant, most);
    if (share <= most) return;
    most = share;
    best = finding;
  };
  consider(mirrored(plan), {.fault = MapFault::kMirrored});
  for (const core::FloorPlan& other : others) {
    consider(other, {.fault = MapFault::kOtherMap, .map = other.name});
  }
  for (const double unit : kUnits) {
    const core::Vec2 scale(unit, unit);
    consider(scaled(plan, scale), {.fault = MapFault::kUnits, .scale = scale});
  }
  // The map as a whole, and a picture that was stretched, or one tape that was off.
  for (const core::Vec2& axes : {core::Vec2(1, 1), core::Vec2(1, 0), core::Vec2(0, 1)}) {
    if (const auto scale = fitting_scale(trials, plan, axes, most)) {
      best = {.fault = MapFault::kScale, .scale = *scale};
    }
  }
  if (trials.is_over()) return std::nullopt;
  return best;
}

bool RecentScans::add(const core::Scan& scan) {
  const core::TimeNs since_ns = scan.start_ns() - newest_ns_;
  if (since_ns > 0 && since_ns < core::kNsPerSecond) return false;
  newest_ns_ = scan.start_ns();
  if (are_enough()) scans_.pop_front();
  scans_.emplace_back(scan.samples().begin(), scan.samples().end());
  return true;
}

bool RecentScans::are_enough() const {
  constexpr std::size_t kScans = 16;
  return scans_.size() == kScans;
}

std::string_view name_of(const MapFinding& finding) {
  constexpr std::array<std::string_view, 5> kNames = {"map-mirrored", "map-scale", "map-units",
                                                      "map-other", "map-mismatch"};
  return kNames[static_cast<std::size_t>(finding.fault)];
}

std::string describe(const MapFinding& finding, const std::string& name) {
  const std::string map = "the map \"" + name + "\"";
  std::array<char, 64> number{};
  const auto text_of = [&](const char* format, double value) {
    std::snprintf(number.data(), number.size(), format, value);
    return std::string(number.data());
  };
  switch (finding.fault) {
    case MapFault::kMirrored:
      return "the scans fit the mirror image of " + map +
             ": change lidar.mount.inverted, or mirror the map, whichever is wrong";
    case MapFault::kScale: {
      const bool is_stretched = finding.scale.x() != finding.scale.y();
      const std::string text =
          "the scans fit " + map + " made " + text_of("%.3f", finding.scale.x()) +
          (is_stretched ? " times as large along x and " + text_of("%.3f", finding.scale.y()) +
                              " times along y"
                        : " times as large") +
          ": cornerctl map scale";
      const bool may_be_lidar =
          !is_stretched && std::abs(finding.scale.x() - 1) < 1.5 * kMaxLidarScale;
      return text + (may_be_lidar ? "; or the lidar's ranges are off by as much: cornerctl "
                                    "calibrate bias, where the map was measured"
                                  : "");
    }
    case MapFault::kUnits:
      return "the scans fit " + map + " where its lengths are times " +
             text_of("%.4g", finding.scale.x()) + ": maps are in metres, cornerctl map scale";
    case MapFault::kOtherMap:
      return "the scans fit the map \"" + finding.map + "\" of the config, not " + map +
             ": set map to it, or SET_MAP";
    case MapFault::kNoVariant:
      return "hardly any scan fits " + map +
             ", nor its mirror image, nor it 0.75 to 1.35 times as large, as a whole or along one "
             "axis, or in another unit: check that it is the map of this place and floor, and that "
             "the robot is inside it";
  }
  return {};
}

}  // namespace cornerd::calibration
