// SPDX-License-Identifier: MIT
#include "bench/survey_experiment.hpp"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <utility>
#include <vector>

#include "bench/building.hpp"
#include "bench/simulated_drive.hpp"
#include "core/localizer.hpp"
#include "replay/simulator/motion.hpp"
#include "survey/ransac_survey.hpp"

namespace cornerd::bench {

SimulatedDrive survey_drive(std::shared_ptr<const core::WallMap> map, std::size_t scans,
                            std::uint64_t seed, bool has_odometry) {
  SimulatedDriveConfig config;
  config.scans = scans;
  config.simulator.seed = seed;
  config.has_odometry = has_odometry;
  config.robot = miscalibrated_robot();
  const replay::Scenario* exploration = replay::find_scenario("exploration");
  return simulate_drive(std::move(map), replay::drive_path(exploration->path, gentle_drive()),
                        config);
}

LocalizationScore localize_drive(std::shared_ptr<const core::WallMap> map,
                                 const SimulatedDrive& drive, const core::Pose2& T_true_map) {
  core::Localizer localizer(std::move(map), {});
  LocalizationScore score;
  std::vector<double> errors_m;
  core::Scan scan;
  for (std::size_t i = 0; i < drive.drive.size(); ++i) {
    drive.drive.load(i, scan);
    const core::PoseEstimate& pose = localizer.step(scan).pose;
    ++score.scans;
    if (pose.state == core::PoseState::kLost || pose.state == core::PoseState::kAmbiguous) continue;
    ++score.named;
    const core::Pose2 off = drive.T_map_base[i].inverse() * (T_true_map * pose.T_map_base);
    const double error_m = off.translation().norm();
    if (error_m > 0.1 || std::abs(off.theta_rad) > core::radians(5)) ++score.wrong;
    errors_m.push_back(error_m);
    score.mean_error_m += error_m;
  }
  if (errors_m.empty()) return score;
  score.mean_error_m /= static_cast<double>(errors_m.size());
  std::sort(errors_m.begin(), errors_m.end());
  score.error_95_m = errors_m[errors_m.size() * 95 / 100];
  return score;
}

namespace {

/// A surveyed flat with more corners is noise, and localizing in it would take hours.
constexpr std::size_t kMaxCorners = 2000;
/// Scans of the second drive: once through all rooms.
constexpr std::size_t kSecondScans = 1200;

double cpu_now_s() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

}  // namespace

SurveyExperiment run_survey_experiment(std::shared_ptr<const core::WallMap> map, std::size_t scans,
                                       std::uint64_t seed) {
  const SimulatedDrive drive = survey_drive(map, scans, seed);
  const SimulatedDrive alone = survey_drive(map, scans, seed, /*has_odometry=*/false);
  const SimulatedDrive second = survey_drive(map, std::min(scans, kSecondScans), seed + 1);
  SurveyExperiment experiment;
  experiment.in_true_map = localize_drive(map, second, {});
  for (std::size_t i = 1; i < drive.T_map_base.size(); ++i) {
    experiment.length_m +=
        (drive.T_map_base[i].translation() - drive.T_map_base[i - 1].translation()).norm();
  }

  const auto add = [&](const char* title, const SimulatedDrive& driven, auto&& make) {
    SurveyCase made;
    made.title = title;
    const double begin_s = cpu_now_s();
    made.result = make();
    made.cpu_s = cpu_now_s() - begin_s;
    made.result.plan.name = title;
    const auto found = std::make_shared<const core::WallMap>(made.result.plan);
    made.score = score_survey(*map, driven.T_map_base, *found, driven.T_map_base.front());
    if (found->corners().size() < kMaxCorners) {
      made.second_drive = localize_drive(found, second, made.score.T_true_map);
    }
    experiment.cases.push_back(std::move(made));
  };
  add("adjusted", drive, [&] { return survey::survey(drive.drive, {}); });
  core::LocalizerConfig calibrated;
  calibrated.odometry.initial =
      experiment.cases.front().result.learned.value_or(core::OdometryParameters());
  add("adjusted, lidar alone", alone, [&] { return survey::survey(alone.drive, {}); });
  add("ransac", drive, [&] { return survey::ransac_survey(drive.drive, {}, {}); });
  add("ransac, calibrated odometry", drive,
      [&] { return survey::ransac_survey(drive.drive, calibrated, {}); });
  return experiment;
}

namespace {

using core::Vec2;

constexpr double kShortRange_m = 4;
constexpr std::size_t kRingScans = 850;
constexpr std::size_t kRoomsScans = 750;
constexpr std::size_t kRoomsInARow = 4;

SimulatedDrive slipping_drive(core::FloorPlan plan, const std::vector<Vec2>& path,
                              std::size_t scans, std::uint64_t seed, bool has_odometry) {
  SimulatedDriveConfig config;
  config.scans = scans;
  config.has_odometry = has_odometry;
  config.simulator.seed = seed;
  config.simulator.sensor.max_range_m = kShortRange_m;
  config.robot = miscalibrated_robot();
  config.robot.slips_per_m = 0.3;
  config.robot.slip_share = 10;
  return simulate_drive(std::make_shared<const core::WallMap>(std::move(plan)),
                        replay::drive_path(path, gentle_drive(0.6)), config);
}

}  // namespace

SimulatedDrive ring_drive(std::uint64_t seed, bool has_odometry) {
  const std::vector<Vec2> around = {{0.8, 2}, {0.8, 0.8}, {19.2, 0.8}, {19.2, 7.2}, {0.8, 7.2}};
  return slipping_drive(ring_corridor(), around, kRingScans, seed, has_odometry);
}

SimulatedDrive equal_rooms_drive(std::uint64_t seed) {
  constexpr double kRoomWidth_m = 3.5;
  std::vector<Vec2> path;
  for (std::size_t room = 0; room < kRoomsInARow; ++room) {
    const Vec2 left(kRoomWidth_m * static_cast<double>(room), 0);
    for (const Vec2& point :
         {Vec2(1.2, 0.9), Vec2(1.2, 4), Vec2(2.2, 4.6), Vec2(1.2, 4.2), Vec2(1.2, 1.1)}) {
      path.push_back(left + point);
    }
  }
  return slipping_drive(equal_rooms(kRoomsInARow), path, kRoomsScans, seed, /*has_odometry=*/true);
}

LoopCase survey_loop(const core::WallMap& map, const SimulatedDrive& drive, bool close_loops) {
  survey::SurveyConfig config;
  config.close_loops = close_loops;
  LoopCase made;
  made.result = survey::survey(drive.drive, config);
  made.score = score_survey(map, drive.T_map_base, core::WallMap(made.result.plan),
                            drive.T_map_base.front());
  for (std::size_t i = 0; i < drive.T_map_base.size(); ++i) {
    const core::Pose2 truth = drive.T_map_base.front().inverse() * drive.T_map_base[i];
    made.worst_m = std::max(made.worst_m,
                            (truth.translation() - made.result.T_map_base[i].translation()).norm());
  }
  return made;
}

}  // namespace cornerd::bench
