// SPDX-License-Identifier: MIT
#include "bench/blind_experiment.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "bench/odometry_experiment.hpp"
#include "bench/simulated_drive.hpp"
#include "core/pipeline.hpp"
#include "replay/pose_error.hpp"
#include "replay/simulator/motion.hpp"
#include "replay/simulator/random.hpp"
#include "replay/simulator/scene.hpp"
#include "replay/simulator/simulated_odometry.hpp"
#include "replay/simulator/simulator.hpp"

namespace cornerd::bench {
namespace {

class CoveredLidarScore {
 public:
  explicit CoveredLidarScore(CoveredLidarResult& result) : result_(result) {}

  void add(const core::PoseEstimate& pose, const core::Pose2& truth) {
    if (pose.state == core::PoseState::kFix) add_to(result_.fixes, pose, truth);
    if (pose.state != core::PoseState::kPredicted) return;
    const auto ages = std::find_if(result_.predicted.begin(), result_.predicted.end(),
                                   [&](const AgeConsistency& a) { return pose.age_s < a.to_s; });
    if (ages != result_.predicted.end()) add_to(*ages, pose, truth);
  }

  void finish() {
    make_means(result_.fixes);
    for (AgeConsistency& ages : result_.predicted) make_means(ages);
  }

 private:
  static void add_to(PoseConsistency& honesty, const core::PoseEstimate& pose,
                     const core::Pose2& truth) {
    const replay::PoseError error = replay::error_of(pose.T_map_base, truth);
    const double nees = replay::normalised_error_squared(pose, truth)
                            .value_or(std::numeric_limits<double>::infinity());
    ++honesty.poses;
    honesty.mean_m += error.position_m;
    honesty.worst_m = std::max(honesty.worst_m, error.position_m);
    honesty.worst_rad = std::max(honesty.worst_rad, error.heading_rad);
    honesty.mean_nees += nees;
    honesty.share_within += nees < replay::kNees95 ? 1 : 0;
  }
  static void make_means(PoseConsistency& honesty) {
    const auto poses = static_cast<double>(std::max<std::size_t>(honesty.poses, 1));
    honesty.mean_m /= poses;
    honesty.mean_nees /= poses;
    honesty.share_within /= poses;
  }

  CoveredLidarResult& result_;
};

bool is_covered(const CoveredLidarCase& blind, core::TimeNs t_ns) {
  const double since_s = core::to_seconds(t_ns) - blind.first_s;
  return since_s >= 0 && std::fmod(since_s, blind.again_s) < blind.covered_s;
}

/// Seeds of the lidar, of wheels and gyro and of the robot: no two drives share any of them.
constexpr std::uint64_t kStreams = 3;
enum Stream : std::uint8_t { kLidarStream, kOdometryStream, kRobotStream };
std::uint64_t seed_of(Stream stream, std::uint64_t drive) { return kStreams * drive + stream; }

/// A robot whose errors are drawn from what the filter is told of them.
void draw_errors(replay::RobotModel& robot, std::uint64_t seed) {
  const core::OdometryNoise told;
  replay::Random random(seed);
  robot.left_scale = told.wheel_scale * random.normal();
  robot.right_scale = told.wheel_scale * random.normal();
  robot.track_scale = told.track_scale * random.normal();
  robot.gyro_scale = told.gyro_scale * random.normal();
  robot.gyro_bias_rad_s = told.gyro_bias_rad_s * random.normal();
}

void drive_blind(std::shared_ptr<const core::WallMap> map, const CoveredLidarCase& blind,
                 std::uint64_t seed, CoveredLidarScore& score) {
  const replay::Motion motion =
      replay::drive_path(replay::find_scenario("exploration")->path, gentle_drive());
  replay::SimulatorConfig simulated;
  simulated.sensor = blind.lidar;
  simulated.seed = seed_of(kLidarStream, seed);
  auto scene =
      std::make_unique<replay::CoverableScene>(std::make_unique<replay::MapScene>(map, motion));
  replay::CoverableScene& world = *scene;
  replay::Simulator simulator(std::move(scene), simulated);
  replay::RobotModel robot = blind.robot;
  if (blind.draws_errors) draw_errors(robot, seed_of(kRobotStream, seed));
  replay::SimulatedOdometry odometry(motion, robot, seed_of(kOdometryStream, seed));

  core::LocalizerConfig config;
  config.odometry.enabled = true;
  config.odometry.publish_predictions = true;
  config.odometry.geometry = robot.geometry;
  core::Pipeline pipeline(std::move(map), config);
  for (core::TimeNs now_ns = 0; core::to_seconds(now_ns) < blind.duration_s;) {
    world.cover(is_covered(blind, now_ns));
    for (const replay::SimulatedSample& sample : simulator.next().samples) {
      while (odometry.next_ns() <= sample.t_ns) {
        if (const core::PoseEstimate* pose = pipeline.add(odometry.next(), sample.t_ns)) {
          score.add(*pose, motion(pose->t_ns, 0));
        }
      }
      if (const core::ScanResult* result = pipeline.add(replay::to_sample(sample))) {
        score.add(result->pose, motion(result->pose.t_ns, 0));
      }
      now_ns = sample.t_ns;
    }
  }
}

}  // namespace

std::vector<CoveredLidarCase> covered_lidar_cases() {
  CoveredLidarCase usual;
  usual.title = "16 cm robot";
  usual.robot = odometry_robots().back().model;
  usual.robot.slips_per_m = 0;
  std::vector<CoveredLidarCase> cases = {usual};
  const auto add = [&](std::string_view title, auto&& differ) {
    cases.push_back(usual);
    cases.back().title = title;
    differ(cases.back());
  };
  const auto twice_the_noise = [](CoveredLidarCase& blind) {
    blind.robot.wheel_m_per_sqrt_m = 0.002;
    blind.robot.gyro_rad_s_per_sqrt_hz = 0.0005;
  };
  const auto slips = [](CoveredLidarCase& blind) { blind.robot.slips_per_m = 0.3; };
  const auto no_gyro = [](CoveredLidarCase& blind) { blind.robot.has_gyro = false; };
  const auto pioneer = [](CoveredLidarCase& blind) {
    blind.robot.geometry = odometry_robots().front().model.geometry;
  };
  add("twice the noise", twice_the_noise);
  add("slips every 3 m", slips);
  add("no gyro", no_gyro);
  add("no gyro, twice the noise", [&](CoveredLidarCase& blind) {
    no_gyro(blind);
    twice_the_noise(blind);
  });
  add("no gyro, slips every 3 m", [&](CoveredLidarCase& blind) {
    no_gyro(blind);
    slips(blind);
  });
  add("counts of 5 mm", [](CoveredLidarCase& blind) { blind.robot.geometry.counts_per_turn = 40; });
  add("after 3 s, robots drawn", [](CoveredLidarCase& blind) {
    blind.first_s = 3;
    blind.duration_s = 8;
    blind.draws_errors = true;
    blind.drives_for_one = 15;
  });
  add("a lidar off by 5 mm and 0.5 %", [](CoveredLidarCase& blind) {
    blind.lidar.range_offset_m = 0.005;
    blind.lidar.range_scale = 1.005;
  });
  add("Pioneer P3-DX", pioneer);
  add("Pioneer, no gyro", [&](CoveredLidarCase& blind) {
    pioneer(blind);
    no_gyro(blind);
  });
  add("Pioneer, slips every 3 m", [&](CoveredLidarCase& blind) {
    pioneer(blind);
    slips(blind);
  });
  return cases;
}

CoveredLidarResult run_covered_lidar_case(std::shared_ptr<const core::WallMap> map, const CoveredLidarCase& blind,
                           std::uint64_t seed, std::size_t drives) {
  CoveredLidarResult result;
  constexpr double kAges_s[] = {0, 0.25, 1, 2, 5};
  for (std::size_t i = 0; i < result.predicted.size(); ++i) {
    result.predicted[i].from_s = kAges_s[i];
    result.predicted[i].to_s = kAges_s[i + 1];
  }
  CoveredLidarScore score(result);
  drives *= blind.drives_for_one;
  for (std::size_t i = 0; i < drives; ++i) drive_blind(map, blind, seed + i, score);
  score.finish();
  return result;
}

}  // namespace cornerd::bench
