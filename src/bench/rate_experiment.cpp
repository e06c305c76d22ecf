// SPDX-License-Identifier: MIT
#include "bench/rate_experiment.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "bench/simulated_drive.hpp"
#include "core/pipeline.hpp"
#include "replay/pose_error.hpp"
#include "replay/simulator/motion.hpp"
#include "replay/simulator/simulated_odometry.hpp"
#include "replay/simulator/simulator.hpp"

namespace cornerd::bench {
namespace {

constexpr double kSlowSpeed_m_s = 0.25;

void score_scan(const core::PoseEstimate& pose, const core::Pose2& truth, RateResult& result) {
  ++result.scans;
  const replay::PoseError error = replay::error_of(pose.T_map_base, truth);
  if (pose.state == core::PoseState::kFix) {
    result.fixes.add(pose, truth);
    result.worst_fix_m = std::max(result.worst_fix_m, error.position_m);
    result.worst_fix_rad = std::max(result.worst_fix_rad, error.heading_rad);
  } else if (pose.state == core::PoseState::kPredicted) {
    result.predicted.add(pose, truth);
    result.worst_predicted_rad = std::max(result.worst_predicted_rad, error.heading_rad);
  }
}

}  // namespace

RateResult run_rate_case(std::shared_ptr<const core::WallMap> map, double rate_hz, bool gently,
                         std::size_t scans, std::uint64_t seed) {
  replay::DriveConfig drive = gentle_drive(kSlowSpeed_m_s);
  if (!gently) drive.acceleration_m_s2 = drive.yaw_acceleration_rad_s2 = 0;
  const replay::Motion motion =
      replay::drive_path(replay::find_scenario("exploration")->path, drive);
  replay::SimulatorConfig simulated;
  simulated.seed = seed;
  replay::Simulator simulator(std::make_unique<replay::MapScene>(map, motion), simulated);
  replay::RobotModel robot = miscalibrated_robot();
  std::optional<replay::SimulatedOdometry> odometry;
  if (rate_hz > 0) {
    robot.rate_hz = rate_hz;
    odometry.emplace(motion, robot, seed + 1);
  }
  core::LocalizerConfig config;
  config.odometry.enabled = odometry.has_value();
  config.odometry.geometry = robot.geometry;
  core::Pipeline pipeline(std::move(map), config);
  RateResult result;
  while (result.scans < scans) {
    for (const replay::SimulatedSample& sample : simulator.next().samples) {
      while (odometry && odometry->next_ns() <= sample.t_ns) {
        pipeline.add(odometry->next().arrived(sample.t_ns));
      }
      if (const core::ScanResult* scan = pipeline.add(replay::to_sample(sample))) {
        score_scan(scan->pose, motion(scan->pose.t_ns, 0), result);
      }
    }
  }
  return result;
}

}  // namespace cornerd::bench
