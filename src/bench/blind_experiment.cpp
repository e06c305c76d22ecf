// SPDX-License-Identifier: MIT
#include "bench/blind_experiment.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/Cholesky>

#include "bench/odometry_experiment.hpp"
#include "core/pipeline.hpp"
#include "replay/simulator/coverable_scene.hpp"
#include "replay/simulator/motion.hpp"
#include "replay/simulator/scenarios.hpp"
#include "replay/simulator/simulated_odometry.hpp"
#include "replay/simulator/simulator.hpp"

namespace cornerd::bench {
namespace {

/// Chi-square with three degrees of freedom that one in twenty exceeds.
constexpr double kNeesOf95 = 7.815;

class BlindScore {
 public:
  explicit BlindScore(BlindResult& result) : result_(result) {}

  void add(const core::PoseEstimate& pose, const core::Pose2& truth) {
    const auto ages = std::find_if(result_.begin(), result_.end(),
                                   [&](const BlindAges& a) { return pose.age_s < a.to_s; });
    if (pose.state != core::PoseState::kPredicted || ages == result_.end()) return;
    const Eigen::Vector3d error(pose.T_map_base.x_m - truth.x_m, pose.T_map_base.y_m - truth.y_m,
                                core::angle_between(truth.theta_rad, pose.T_map_base.theta_rad));
    const double nees = error.dot(Eigen::LLT<Eigen::Matrix3d>(pose.covariance).solve(error));
    ++ages->poses;
    ages->mean_m += error.head<2>().norm();
    ages->worst_m = std::max(ages->worst_m, error.head<2>().norm());
    ages->worst_rad = std::max(ages->worst_rad, std::abs(error.z()));
    ages->mean_nees += nees;
    ages->share_within += nees < kNeesOf95 ? 1 : 0;
  }

  void finish() {
    for (BlindAges& ages : result_) {
      const auto poses = static_cast<double>(std::max<std::size_t>(ages.poses, 1));
      ages.mean_m /= poses;
      ages.mean_nees /= poses;
      ages.share_within /= poses;
    }
  }

 private:
  BlindResult& result_;
};

bool is_covered(const BlindCase& blind, core::TimeNs t_ns) {
  const double since_s = core::to_seconds(t_ns) - blind.first_s;
  return since_s >= 0 && std::fmod(since_s, blind.again_s) < blind.covered_s;
}

void drive_blind(std::shared_ptr<const core::WallMap> map, const BlindCase& blind,
                 std::uint64_t seed, BlindScore& score) {
  const replay::Motion motion =
      replay::drive_path(replay::find_scenario("exploration")->path, gentle_drive());
  replay::SimulatorConfig simulated;
  simulated.sensor = blind.lidar;
  simulated.seed = seed;
  auto scene =
      std::make_unique<replay::CoverableScene>(std::make_unique<replay::MapScene>(map, motion));
  replay::CoverableScene& world = *scene;
  replay::Simulator simulator(std::move(scene), simulated);
  replay::SimulatedOdometry odometry(motion, blind.robot, seed + 1);

  core::LocalizerConfig config;
  config.odometry.enabled = true;
  config.odometry.publish = true;
  config.odometry.geometry = blind.robot.geometry;
  core::Pipeline pipeline(std::move(map), config);
  for (core::TimeNs now_ns = 0; core::to_seconds(now_ns) < blind.duration_s;) {
    world.cover(is_covered(blind, now_ns));
    for (const replay::SimulatedSample& sample : simulator.next().samples) {
      while (odometry.next_ns() <= sample.t_ns) {
        if (const core::PoseEstimate* pose = pipeline.add(odometry.next(), sample.t_ns)) {
          score.add(*pose, motion(pose->t_ns, 0));
        }
      }
      pipeline.add(replay::to_sample(sample));
      now_ns = sample.t_ns;
    }
  }
}

}  // namespace

std::vector<BlindCase> blind_cases() {
  BlindCase usual;
  usual.title = "16 cm robot";
  usual.robot = odometry_robots().back().model;
  usual.robot.slips_per_m = 0;
  BlindCase noisy = usual;
  noisy.title = "twice the noise";
  noisy.robot.wheel_m_per_sqrt_m = 0.002;
  noisy.robot.gyro_rad_s_per_sqrt_hz = 0.0005;
  BlindCase slips = usual;
  slips.title = "slips every 3 m";
  slips.robot.slips_per_m = 0.3;
  BlindCase wheels = usual;
  wheels.title = "no gyro";
  wheels.robot.has_gyro = false;
  BlindCase early = usual;
  early.title = "after 3 s of driving";
  early.first_s = 3;
  early.duration_s = 8;
  BlindCase biased = usual;
  biased.title = "a lidar off by 5 mm and 0.5 %";
  biased.lidar.range_offset_m = 0.005;
  biased.lidar.range_scale = 1.005;
  BlindCase pioneer = usual;
  pioneer.title = "Pioneer P3-DX";
  pioneer.robot.geometry = odometry_robots().front().model.geometry;
  return {usual, noisy, slips, wheels, early, biased, pioneer};
}

BlindResult run_blind_case(std::shared_ptr<const core::WallMap> map, const BlindCase& blind,
                           std::uint64_t seed, std::size_t drives) {
  BlindResult result{{{.from_s = 0, .to_s = 0.25},
                      {.from_s = 0.25, .to_s = 1},
                      {.from_s = 1, .to_s = 2},
                      {.from_s = 2, .to_s = 5}}};
  BlindScore score(result);
  for (std::size_t i = 0; i < drives; ++i) drive_blind(map, blind, seed + i, score);
  score.finish();
  return result;
}

}  // namespace cornerd::bench
