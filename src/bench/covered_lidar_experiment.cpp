// SPDX-License-Identifier: MIT
#include "bench/covered_lidar_experiment.hpp"

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
  static void add_to(PoseConsistency& consistency, const core::PoseEstimate& pose,
                     const core::Pose2& truth) {
    const replay::PoseError error = replay::error_of(pose.T_map_base, truth);
    const double nees = replay::normalised_error_squared(pose, truth)
                            .value_or(std::numeric_limits<double>::infinity());
    ++consistency.poses;
    consistency.mean_m += error.position_m;
    consistency.worst_m = std::max(consistency.worst_m, error.position_m);
    consistency.worst_rad = std::max(consistency.worst_rad, error.heading_rad);
    consistency.mean_nees += nees;
    consistency.share_within += nees < replay::kNees95 ? 1 : 0;
  }
  static void make_means(PoseConsistency& consistency) {
    const auto poses = static_cast<double>(std::max<std::size_t>(consistency.poses, 1));
    consistency.mean_m /= poses;
    consistency.mean_nees /= poses;
    consistency.share_within /= poses;
  }

  CoveredLidarResult& result_;
};

bool is_covered(const CoveredLidarCase& test_case, core::TimeNs t_ns) {
  const double since_s = core::to_seconds(t_ns) - test_case.first_cover_s;
  return since_s >= 0 && std::fmod(since_s, test_case.cover_period_s) < test_case.cover_duration_s;
}

/// Independent random streams: no two drives share a seed.
constexpr std::uint64_t kStreams = 3;
enum Stream : std::uint8_t { kLidarStream, kOdometryStream, kRobotStream };
std::uint64_t seed_of(Stream stream, std::uint64_t drive) { return kStreams * drive + stream; }

/// Draws the robot's errors from the filter's initial covariance.
void draw_errors(replay::RobotModel& robot, std::uint64_t seed) {
  const core::OdometryNoise deviations;
  replay::Random random(seed);
  robot.left_scale = deviations.wheel_scale * random.normal();
  robot.right_scale = deviations.wheel_scale * random.normal();
  robot.track_scale = deviations.track_scale * random.normal();
  robot.gyro_scale = deviations.gyro_scale * random.normal();
  robot.gyro_bias_rad_s = deviations.gyro_bias_rad_s * random.normal();
}

void simulate_covered_drive(std::shared_ptr<const core::WallMap> map,
                            const CoveredLidarCase& test_case, std::uint64_t seed,
                            CoveredLidarScore& score) {
  const replay::Motion motion =
      replay::drive_path(replay::find_scenario("exploration")->path, gentle_drive());
  replay::SimulatorConfig simulated;
  simulated.sensor = test_case.lidar;
  simulated.seed = seed_of(kLidarStream, seed);
  auto scene =
      std::make_unique<replay::CoverableScene>(std::make_unique<replay::MapScene>(map, motion));
  replay::CoverableScene& world = *scene;
  replay::Simulator simulator(std::move(scene), simulated);
  replay::RobotModel robot = test_case.robot;
  if (test_case.draws_errors) draw_errors(robot, seed_of(kRobotStream, seed));
  replay::SimulatedOdometry odometry(motion, robot, seed_of(kOdometryStream, seed));

  core::LocalizerConfig config;
  config.odometry.enabled = true;
  config.odometry.publish_predictions = true;
  config.odometry.geometry = robot.geometry;
  core::Pipeline pipeline(std::move(map), config);
  for (core::TimeNs now_ns = 0; core::to_seconds(now_ns) < test_case.duration_s;) {
    world.cover(is_covered(test_case, now_ns));
    for (const replay::SimulatedSample& sample : simulator.next().samples) {
      while (odometry.next_ns() <= sample.t_ns) {
        if (const core::PoseEstimate* pose = pipeline.add(odometry.next().arrived(sample.t_ns))) {
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
  CoveredLidarCase nominal;
  nominal.title = "16 cm robot";
  nominal.robot = odometry_robots().back().model;
  nominal.robot.slips_per_m = 0;
  std::vector<CoveredLidarCase> cases = {nominal};
  const auto add = [&](std::string_view title, auto&& differ) {
    cases.push_back(nominal);
    cases.back().title = title;
    differ(cases.back());
  };
  const auto twice_the_noise = [](CoveredLidarCase& test_case) {
    test_case.robot.wheel_m_per_sqrt_m = 0.002;
    test_case.robot.gyro_rad_s_per_sqrt_hz = 0.0005;
  };
  const auto slips = [](CoveredLidarCase& test_case) { test_case.robot.slips_per_m = 0.3; };
  const auto no_gyro = [](CoveredLidarCase& test_case) { test_case.robot.has_gyro = false; };
  const auto pioneer = [](CoveredLidarCase& test_case) {
    test_case.robot.geometry = odometry_robots().front().model.geometry;
  };
  add("twice the noise", twice_the_noise);
  add("slips every 3 m", slips);
  add("no gyro", no_gyro);
  add("no gyro, twice the noise", [&](CoveredLidarCase& test_case) {
    no_gyro(test_case);
    twice_the_noise(test_case);
  });
  add("no gyro, slips every 3 m", [&](CoveredLidarCase& test_case) {
    no_gyro(test_case);
    slips(test_case);
  });
  add("counts of 5 mm",
      [](CoveredLidarCase& test_case) { test_case.robot.geometry.counts_per_turn = 40; });
  add("after 3 s, robots drawn", [](CoveredLidarCase& test_case) {
    test_case.first_cover_s = 3;
    test_case.duration_s = 8;
    test_case.draws_errors = true;
    test_case.drive_factor = 15;
  });
  add("a lidar off by 5 mm and 0.5 %", [](CoveredLidarCase& test_case) {
    test_case.lidar.range_offset_m = 0.005;
    test_case.lidar.range_scale = 1.005;
  });
  add("Pioneer P3-DX", pioneer);
  add("Pioneer, no gyro", [&](CoveredLidarCase& test_case) {
    pioneer(test_case);
    no_gyro(test_case);
  });
  add("Pioneer, slips every 3 m", [&](CoveredLidarCase& test_case) {
    pioneer(test_case);
    slips(test_case);
  });
  return cases;
}

CoveredLidarResult run_covered_lidar_case(std::shared_ptr<const core::WallMap> map,
                                          const CoveredLidarCase& test_case, std::uint64_t seed,
                                          std::size_t drives) {
  CoveredLidarResult result;
  constexpr double kAges_s[] = {0, 0.25, 1, 2, 5};
  for (std::size_t i = 0; i < result.predicted.size(); ++i) {
    result.predicted[i].from_s = kAges_s[i];
    result.predicted[i].to_s = kAges_s[i + 1];
  }
  CoveredLidarScore score(result);
  drives *= test_case.drive_factor;
  for (std::size_t i = 0; i < drives; ++i) simulate_covered_drive(map, test_case, seed + i, score);
  score.finish();
  return result;
}

}  // namespace cornerd::bench
