// SPDX-License-Identifier: MIT
#include "bench/odometry_experiment.hpp"

#include "bench/simulated_drive.hpp"
#include "core/odometry/reading_gate.hpp"
#include "replay/simulator/motion.hpp"
#include "replay/simulator/simulated_odometry.hpp"

namespace cornerd::bench {
namespace {

using calibration::HeadingSource;

/// The truth is sampled at the ends of the paper's steps.
constexpr core::TimeNs kTruthPeriod_ns = kPaperStep_ns;

struct Drive {
  core::DriveGeometry geometry;
  std::vector<core::OdometryIncrement> steps;
  std::vector<core::OdometryIncrement> paper_steps;  ///< the same, joined
  std::vector<calibration::KnownPose> poses;
};

/// Joins increments to steps of kPaperStep_ns.
std::vector<core::OdometryIncrement> joined(const std::vector<core::OdometryIncrement>& steps) {
  std::vector<core::OdometryIncrement> joined;
  bool goes_on = false;
  for (const core::OdometryIncrement& step : steps) {
    if (goes_on) {
      core::OdometryIncrement& last = joined.back();
      last.to_ns = step.to_ns;
      last.left_m += step.left_m;
      last.right_m += step.right_m;
      last.gyro_rad += step.gyro_rad;
      last.has_gyro = last.has_gyro && step.has_gyro;
    } else {
      joined.push_back(step);
    }
    goes_on = step.to_ns % kPaperStep_ns != 0;
  }
  return joined;
}

Drive drive_once(const OdometryRobot& robot, const replay::Scenario& scenario, std::uint64_t seed) {
  const replay::Motion motion = replay::drive_path(scenario.path, gentle_drive());
  const core::TimeNs end_ns =
      core::from_seconds(replay::drive_duration_s(scenario.path, gentle_drive()));
  Drive drive;
  drive.geometry = robot.model.geometry;
  core::OdometryConfig config;
  config.geometry = drive.geometry;
  core::ReadingGate gate(config);
  replay::SimulatedOdometry odometry(motion, robot.model, seed);
  while (odometry.next_ns() <= end_ns) {
    if (const auto step = gate.add(odometry.next())) drive.steps.push_back(*step);
  }
  drive.paper_steps = joined(drive.steps);
  for (core::TimeNs t_ns = 0; t_ns <= end_ns; t_ns += kTruthPeriod_ns) {
    drive.poses.push_back({t_ns, motion(t_ns, 0)});
  }
  return drive;
}

ReckonedTrack reckon_by_mode(const Drive& drive, HeadingSource source, bool as_printed,
                             bool with_factors) {
  ReckonedTrack track;
  track.source = source;
  track.as_printed = as_printed;
  const auto& steps = as_printed ? drive.paper_steps : drive.steps;
  calibration::DeadReckoningConfig config{source, {}};
  if (as_printed) config.factors.dead_band_rad = kPaperDeadBand_rad;
  if (with_factors) {
    track.factors = calibration::search_factors(steps, drive.poses, drive.geometry, config);
    config.factors = track.factors->factors;
  }
  track.error = calibration::reckon(steps, drive.poses, drive.geometry, config, &track.points);
  return track;
}

/// Heading of the gyro, corrected by the fitted parameters.
ReckonedTrack reckon_by_fit(const Drive& drive, const core::OdometryParameters& learned) {
  ReckonedTrack track;
  track.source = HeadingSource::kFilter;
  track.error =
      calibration::reckon(drive.steps, drive.poses, drive.geometry, learned, &track.points);
  return track;
}

}  // namespace

std::vector<OdometryRobot> odometry_robots() {
  replay::RobotModel wrong = miscalibrated_robot();
  wrong.slips_per_m = 0.05;
  OdometryRobot pioneer{"Pioneer P3-DX", "pioneer", wrong};
  pioneer.model.geometry = {.wheel_radius_m = 0.0975, .track_m = 0.331, .counts_per_turn = 76600};
  OdometryRobot contest{"contest robot, 16 cm", "contest", wrong};
  contest.model.geometry = {.wheel_radius_m = 0.0325, .track_m = 0.16, .counts_per_turn = 1440};
  return {pioneer, contest};
}

OdometryResult run_odometry_case(const OdometryRobot& robot, const replay::Scenario& scenario,
                                 std::uint64_t seed) {
  const Drive drive = drive_once(robot, scenario, seed);
  OdometryResult result;
  result.scenario = scenario.name;
  for (const calibration::KnownPose& place : drive.poses) {
    const core::Vec2 point = place.T_map_base.translation();
    if (!result.truth.empty()) result.length_m += (point - result.truth.back()).norm();
    result.truth.push_back(point);
  }
  constexpr HeadingSource kModes[] = {HeadingSource::kEncoder, HeadingSource::kGyro,
                                      HeadingSource::kMean, HeadingSource::kWeighted};
  for (const bool as_printed : {true, false}) {
    for (const HeadingSource mode : kModes) {
      // Without factors the weighted mean equals the mean.
      if (mode == HeadingSource::kWeighted) continue;
      result.tracks.push_back(reckon_by_mode(drive, mode, as_printed, /*with_factors=*/false));
    }
    for (const HeadingSource mode : kModes) {
      if (mode == HeadingSource::kMean) continue;
      result.tracks.push_back(reckon_by_mode(drive, mode, as_printed, /*with_factors=*/true));
    }
  }
  if (const auto fit = calibration::fit_odometry(drive.steps, drive.poses, drive.geometry)) {
    result.tracks.push_back(reckon_by_fit(drive, fit->learned));
  }
  return result;
}

}  // namespace cornerd::bench
