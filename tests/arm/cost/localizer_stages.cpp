// SPDX-License-Identifier: MIT
#include "localizer_stages.hpp"

#include <cmath>
#include <utility>

#include "markers.hpp"

CORNERD_COST_STAGE(detect)
CORNERD_COST_STAGE(recognize)
CORNERD_COST_STAGE(refine)
CORNERD_COST_STAGE(likelihood)
CORNERD_COST_STAGE(first_fix)
CORNERD_COST_STAGE(clutter)
CORNERD_COST_STAGE(lost)
CORNERD_COST_STAGE(odometry)

namespace cornerd {
namespace {

/// Posts that no map has stop three rays in ten, at six tenths of their way.
core::Scan among_posts(const core::Scan& scan) {
  constexpr double kSpacing_rad = core::radians(15);
  constexpr double kWidth_rad = core::radians(4.5);
  core::Scan furnished;
  for (core::Sample sample : scan.samples()) {
    const double beyond_rad = std::fmod(sample.bearing_rad + core::kTwoPi, kSpacing_rad);
    if (beyond_rad < kWidth_rad) sample.range_m *= 0.6F;
    furnished.add(sample);
  }
  return furnished;
}

/// The same room, mirrored and half as large again: of no place of the map.
core::Scan of_another_room(const core::Scan& scan) {
  core::Scan other;
  for (core::Sample sample : scan.samples()) {
    sample.bearing_rad = -sample.bearing_rad;
    sample.range_m *= 1.5F;
    other.add(sample);
  }
  return other;
}

/// As the daemon does, which searches the map in parts.
core::LocalizerConfig in_real_time() {
  core::LocalizerConfig config;
  config.search_nodes_per_scan = core::kSearchInRealTime;
  return config;
}

core::OdometryConfig with_readings() {
  core::OdometryConfig config;
  config.enabled = true;
  return config;
}

}  // namespace

LocalizerStages::LocalizerStages(std::shared_ptr<const core::WallMap> map, replay::Motion drive)
    : map_(std::move(map)),
      config_(in_real_time()),
      catalog_(*map_, config_.max_range_m),
      recognition_(catalog_),
      detector_(config_.detector, config_.noise),
      refinement_(config_.max_range_m, config_.noise),
      prediction_(config_.max_range_m),
      beam_model_(*map_, config_.noise),
      fresh_(map_, config_),
      elsewhere_(map_, config_),
      readings_(std::move(drive), {}, 1),
      odometer_(with_readings()) {}

void LocalizerStages::count(const core::Scan& scan, const core::ScanResult& result) {
  count_parts(scan, result);
  count_searches(scan);
  count_odometry(scan, result);
}

void LocalizerStages::count_parts(const core::Scan& scan, const core::ScanResult& result) {
  cost_begin_detect();
  points_.assign(scan, config_.min_range_m, config_.max_range_m, result.pose.t_ns);
  detector_.detect(points_, detection_);
  cost_end_detect();

  cost_begin_recognize();
  static_cast<void>(recognition_.from_pairs(detection_.breakpoints));
  cost_end_recognize();

  thin_.clear();
  for (std::size_t i = 0; i < points_.size(); i += 4) thin_.push_back(points_[i]);
  core::Pose2 start = result.pose.T_map_base;
  start.x_m += 0.02;
  start.theta_rad += 0.02;
  cost_begin_refine();
  const core::RefinedPose refined =
      refinement_.refine(*map_, start, 0.15, thin_, points_.points(), 1);
  cost_end_refine();

  cost_begin_likelihood();
  const auto hits = prediction_.cast(*map_, refined.T_map_lidar, points_.points());
  beam_model_.meet(points_.points(), hits, refined.T_map_lidar, points_.spacing_rad(), 1);
  static_cast<void>(beam_model_.counts());
  cost_end_likelihood();
}

void LocalizerStages::count_searches(const core::Scan& scan) {
  fresh_.relocalize();
  cost_begin_first_fix();
  static_cast<void>(fresh_.step(scan));
  cost_end_first_fix();

  const core::Scan furnished = among_posts(scan);
  fresh_.relocalize();
  cost_begin_clutter();
  static_cast<void>(fresh_.step(furnished));
  cost_end_clutter();

  // No relocalize(): a search of the map that one scan does not end goes on in the next.
  const core::Scan other = of_another_room(scan);
  cost_begin_lost();
  static_cast<void>(elsewhere_.step(other));
  cost_end_lost();
}

void LocalizerStages::count_odometry(const core::Scan& scan, const core::ScanResult& result) {
  std::vector<core::OdometryReading> readings;
  while (readings_.next_ns() <= scan.end_ns()) readings.push_back(readings_.next());
  cost_begin_odometry();
  for (const core::OdometryReading& reading : readings) odometer_.add(reading);
  odometer_.advance(scan.start_ns(), result.pose.t_ns, scan.end_ns());
  static_cast<void>(odometer_.deskew(scan, core::Pose2{}, deskewed_));
  static_cast<void>(odometer_.prediction());
  odometer_.correct(result.pose.T_map_base, result.pose.covariance);
  cost_end_odometry();
}

}  // namespace cornerd
