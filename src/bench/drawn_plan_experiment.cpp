// SPDX-License-Identifier: MIT
#include "bench/drawn_plan_experiment.hpp"

#include <cmath>
#include <vector>

#include "bench/drawn_plan.hpp"
#include "bench/simulated_drive.hpp"

namespace cornerd::bench {
namespace {

constexpr double kHalf_s = 60;
constexpr double kSpeed_m_s = 0.4;

struct Pair {
  core::Vec2 estimate;
  core::Vec2 truth;
};

/// Least squares over translation and rotation (Horn, in the plane).
double aligned_error_m(const std::vector<Pair>& pairs) {
  if (pairs.empty()) return 0;
  const auto count = static_cast<double>(pairs.size());
  core::Vec2 estimate = core::Vec2::Zero();
  core::Vec2 truth = core::Vec2::Zero();
  for (const Pair& pair : pairs) {
    estimate += pair.estimate / count;
    truth += pair.truth / count;
  }
  double cosine = 0;
  double sine = 0;
  for (const Pair& pair : pairs) {
    const core::Vec2 a = pair.estimate - estimate;
    const core::Vec2 b = pair.truth - truth;
    cosine += a.dot(b);
    sine += a.x() * b.y() - a.y() * b.x();
  }
  const core::Pose2 rotation{0, 0, std::atan2(sine, cosine)};
  double sum_m = 0;
  for (const Pair& pair : pairs) {
    sum_m += (rotation * core::Vec2(pair.estimate - estimate) + truth - pair.truth).norm();
  }
  return sum_m / count;
}

}  // namespace

void drive_in_drawn_plan(const std::shared_ptr<const core::WallMap>& building,
                         const std::shared_ptr<const core::WallMap>& map, std::uint64_t seed,
                         const DrawnPlanCase& test_case, DrawnPlanResult& result) {
  SimulatedDriveConfig config;
  config.has_odometry = test_case.has_odometry;
  config.robot = miscalibrated_robot();
  config.simulator.seed = seed;
  config.scans = static_cast<std::size_t>(2 * kHalf_s * config.simulator.motor_hz);
  const replay::Motion motion = replay::drive_path(
      random_drive(*building, 2 * kHalf_s * kSpeed_m_s, seed), gentle_drive(kSpeed_m_s));
  const SimulatedDrive drive = simulate_drive(building, motion, config);

  core::LocalizerConfig localizer_config;
  localizer_config.learn_walls = test_case.learns_walls;
  localizer_config.odometry.enabled = test_case.has_odometry;
  localizer_config.odometry.geometry = config.robot.geometry;
  core::Localizer localizer(map, localizer_config);
  std::vector<Pair> pairs;
  std::size_t done = 0;
  localize_drive(localizer, drive, [&](const core::PoseEstimate& pose, const core::Pose2& truth) {
    const bool is_first = 2 * done++ < drive.drive.size();
    (is_first ? result.first : result.later).add(pose, truth);
    if (!is_first && has_pose(pose.state)) {
      pairs.push_back({pose.T_map_base.translation(), truth.translation()});
    }
  });
  result.aligned_errors_m.push_back(aligned_error_m(pairs));
}

}  // namespace cornerd::bench
