// SPDX-License-Identifier: MIT
#include "bench/odometry_experiment.hpp"

#include "core/odometry/reading_gate.hpp"
#include "replay/simulator/motion.hpp"
#include "replay/simulator/simulated_odometry.hpp"

namespace cornerd::bench {
namespace {

using core::HeadingSource;

/// How often the truth is looked at, as often as a lidar turns.
constexpr core::TimeNs kLook_ns = 140'000'000;

struct Drive {
  core::DriveGeometry geometry;
  std::vector<core::MotionStep> steps;
  std::vector<calibration::KnownPlace> places;
};

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
    if (const auto step = gate.add(odometry.next(), std::nullopt)) drive.steps.push_back(*step);
  }
  for (core::TimeNs t_ns = 0; t_ns <= end_ns; t_ns += kLook_ns) {
    drive.places.push_back({t_ns, motion(t_ns, 0)});
  }
  return drive;
}

ReckonedTrack reckon_by_mode(const Drive& drive, HeadingSource source,
                             const std::optional<core::PaperFactors>& factors) {
  ReckonedTrack track{.source = source, .factors = factors, .error = {}, .points = {}};
  const core::DeadReckoningConfig config{source, factors.value_or(core::PaperFactors{})};
  track.error =
      calibration::reckon(drive.steps, drive.places, drive.geometry, config, &track.points);
  return track;
}

/// The heading is the gyro's, its errors and the wheels' taken off.
ReckonedTrack reckon_by_fit(const Drive& drive, const core::LearnedOdometry& learned) {
  ReckonedTrack track{
      .source = HeadingSource::kFilter, .factors = std::nullopt, .error = {}, .points = {}};
  track.error =
      calibration::reckon(drive.steps, drive.places, drive.geometry, learned, &track.points);
  return track;
}

}  // namespace

replay::DriveConfig gentle_drive() {
  replay::DriveConfig drive;
  drive.speed_m_s = 0.4;
  drive.acceleration_m_s2 = 1;
  drive.yaw_acceleration_rad_s2 = 6;
  drive.loop = true;
  return drive;
}

std::vector<OdometryRobot> odometry_robots() {
  replay::RobotModel wrong;
  wrong.left_scale = 0.015;
  wrong.right_scale = 0.025;
  wrong.gyro_scale = 0.02;
  wrong.gyro_bias_rad_s = 0.01;
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
  for (const calibration::KnownPlace& place : drive.places) {
    const core::Vec2 point = place.T_map_base.translation();
    if (!result.truth.empty()) result.length_m += (point - result.truth.back()).norm();
    result.truth.push_back(point);
  }
  constexpr HeadingSource kModes[] = {HeadingSource::kEncoder, HeadingSource::kGyro,
                                      HeadingSource::kMean, HeadingSource::kWeighted};
  for (const HeadingSource mode : kModes) {
    // Without factors the weighted mean is the mean.
    if (mode != HeadingSource::kWeighted) {
      result.tracks.push_back(reckon_by_mode(drive, mode, std::nullopt));
    }
  }
  for (const HeadingSource mode : kModes) {
    if (mode == HeadingSource::kMean) continue;
    const core::PaperFactors factors =
        calibration::search_factors(drive.steps, drive.places, drive.geometry, {mode, {}});
    result.tracks.push_back(reckon_by_mode(drive, mode, factors));
  }
  if (const auto fit = calibration::fit_odometry(drive.steps, drive.places, drive.geometry)) {
    result.tracks.push_back(reckon_by_fit(drive, fit->learned));
  }
  return result;
}

}  // namespace cornerd::bench
