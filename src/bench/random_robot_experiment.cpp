// SPDX-License-Identifier: MIT
#include "bench/random_robot_experiment.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>
#include <optional>
#include <tuple>
#include <utility>

#include "core/pipeline.hpp"
#include "replay/pose_error.hpp"
#include "replay/simulator/motion.hpp"
#include "replay/simulator/random.hpp"
#include "replay/simulator/scene.hpp"
#include "replay/simulator/simulator.hpp"

namespace cornerd::bench {
namespace {

constexpr double kDuration_s = 250;
constexpr double kFirstCover_s = 20;
constexpr double kCoverPeriod_s = 7;
constexpr double kCover_s = 4;
/// 99.9 % of chi-square with 3 degrees of freedom.
constexpr double kNees999 = 16.27;
/// Half of the drives have a fault.
constexpr double kFaultShare = 0.5;

double log_uniform(replay::Random& random, double least, double most) {
  return least * std::pow(most / least, random.uniform());
}

int cover_at(core::TimeNs t_ns) {
  const double since_s = core::to_seconds(t_ns) - kFirstCover_s;
  if (since_s < 0 || std::fmod(since_s, kCoverPeriod_s) >= kCover_s) return -1;
  return static_cast<int>(since_s / kCoverPeriod_s);
}

/// Spoils readings as the robot's fault and clock do.
class FaultySensors {
 public:
  explicit FaultySensors(const RandomRobot& robot) : robot_(robot), random_(robot.seed + 0x5EED) {}

  /// nullopt: the reading is lost.
  std::optional<core::OdometryReading> spoil(core::OdometryReading reading) {
    const core::TimeNs true_ns = reading.t_ns;
    reading.t_ns +=
        core::from_seconds(robot_.delay_s + std::clamp(robot_.jitter_s * random_.normal(),
                                                       -3 * robot_.jitter_s, 3 * robot_.jitter_s));
    if (core::to_seconds(true_ns) < robot_.fault_s) return reading;
    if (!held_) held_ = reading;
    const auto scaled = [&](std::int64_t count, std::int64_t from, double factor) {
      return from + std::llround(factor * static_cast<double>(count - from));
    };
    switch (robot_.fault) {
      case OdometryFault::kWheelsSwapped:
        std::tie(reading.left, reading.right) =
            std::pair(*held_->left + *reading.right - *held_->right,
                      *held_->right + *reading.left - *held_->left);
        break;
      case OdometryFault::kLeftReversed:
        reading.left = scaled(*reading.left, *held_->left, -1);
        break;
      case OdometryFault::kGyroReversed:
        if (reading.gyro_rad_s) *reading.gyro_rad_s *= -1;
        break;
      case OdometryFault::kGyroStuck:
        reading.gyro_rad_s = held_->gyro_rad_s;
        break;
      case OdometryFault::kGyroInDegrees:
        if (reading.gyro_rad_s) *reading.gyro_rad_s = core::degrees(*reading.gyro_rad_s);
        break;
      case OdometryFault::kLeftDead:
        reading.left = held_->left;
        break;
      case OdometryFault::kBothDead:
        reading.left = held_->left;
        reading.right = held_->right;
        break;
      case OdometryFault::kWrongCounts:
        reading.left = scaled(*reading.left, *held_->left, 2);
        reading.right = scaled(*reading.right, *held_->right, 2);
        break;
      case OdometryFault::kGyroMissing:
        reading.gyro_rad_s.reset();
        break;
      case OdometryFault::kPauses:
        if (std::fmod(core::to_seconds(true_ns), 5) < 0.8) return std::nullopt;
        break;
      case OdometryFault::kClockStep:
        reading.t_ns += core::from_seconds(0.08);
        break;
      case OdometryFault::kTyreChanges:
        reading.left = scaled(*reading.left, *held_->left, 0.97);
        break;
      default:
        break;
    }
    return reading;
  }

 private:
  RandomRobot robot_;
  replay::Random random_;
  std::optional<core::OdometryReading> held_;
};

}  // namespace

std::string_view name_of(OdometryFault fault) {
  constexpr std::string_view kNames[] = {
      "none",        "wheels swapped", "left reversed", "gyro reversed", "gyro stuck",
      "gyro in deg", "left dead",      "both dead",     "counts x 2",    "gyro missing",
      "pauses",      "clock step",     "tyre changes"};
  return kNames[static_cast<std::size_t>(fault)];
}

RandomRobot draw_robot(std::uint64_t seed) {
  replay::Random random(seed * 7919 + 17);
  RandomRobot robot;
  robot.seed = seed;
  replay::RobotModel& model = robot.model;
  core::DriveGeometry& geometry = model.geometry;
  geometry.wheel_radius_m = random.uniform(0.02, 0.1);
  geometry.track_m = random.uniform(0.1, 0.45);
  const double count_m = log_uniform(random, 5e-5, 5e-3);
  geometry.counts_per_turn =
      std::max(8.0, std::round(core::kTwoPi * geometry.wheel_radius_m / count_m));
  geometry.counter_max = 0;
  model.rate_hz = log_uniform(random, 10, 200);
  model.has_gyro = random.chance(0.7);
  model.left_scale = 0.03 * random.normal();
  model.right_scale = 0.03 * random.normal();
  model.track_scale = 0.05 * random.normal();
  model.gyro_scale = 0.03 * random.normal();
  model.gyro_bias_rad_s = 0.02 * random.normal();
  model.wheel_m_per_sqrt_m = log_uniform(random, 4e-4, 4e-3);
  model.gyro_rad_s_per_sqrt_hz = log_uniform(random, 1e-4, 2e-3);
  model.slips_per_m = random.chance(0.5) ? 0 : log_uniform(random, 0.02, 0.5);
  model.slip_share = random.uniform(0.2, 1);
  robot.speed_m_s = random.uniform(0.15, 0.8);
  robot.acceleration_m_s2 = random.uniform(0.5, 2);
  robot.yaw_acceleration_rad_s2 = random.uniform(2, 10);
  robot.lidar_offset_m = 0.003 * random.normal();
  robot.lidar_scale = 1 + 0.002 * random.normal();
  if (random.chance(0.5)) robot.delay_s = random.uniform(-0.05, 0.05);
  if (random.chance(0.5)) robot.jitter_s = log_uniform(random, 1e-4, 5e-3);
  robot.latency_s = random.uniform(0, 0.03);
  if (random.chance(kFaultShare)) {
    robot.fault = static_cast<OdometryFault>(
        1 + random.bits() % (static_cast<std::uint64_t>(OdometryFault::kCount) - 1));
    robot.fault_s = random.chance(0.3) ? 0 : random.uniform(0, kDuration_s / 2);
  }
  return robot;
}

RandomRobotResult run_random_robot(std::shared_ptr<const core::WallMap> map,
                                   const RandomRobot& robot) {
  replay::DriveConfig drive;
  drive.speed_m_s = robot.speed_m_s;
  drive.acceleration_m_s2 = robot.acceleration_m_s2;
  drive.yaw_acceleration_rad_s2 = robot.yaw_acceleration_rad_s2;
  drive.loop = true;
  const replay::Motion motion =
      replay::drive_path(replay::find_scenario("exploration")->path, drive);
  replay::SimulatorConfig simulated;
  simulated.sensor.range_offset_m = robot.lidar_offset_m;
  simulated.sensor.range_scale = robot.lidar_scale;
  simulated.seed = 3 * robot.seed;
  auto scene =
      std::make_unique<replay::CoverableScene>(std::make_unique<replay::MapScene>(map, motion));
  replay::CoverableScene& world = *scene;
  replay::Simulator simulator(std::move(scene), simulated);
  replay::SimulatedOdometry odometry(motion, robot.model, 3 * robot.seed + 1);
  replay::Random random(3 * robot.seed + 2);
  FaultySensors sensors(robot);

  core::LocalizerConfig config;
  config.odometry.enabled = true;
  config.odometry.geometry = robot.model.geometry;
  core::Pipeline pipeline(map, config);
  std::deque<core::OdometryReading> on_their_way;
  RandomRobotResult result;
  core::TimeNs arrival_ns = 0;
  int cover = -1;
  double last_nees = 0;
  double last_error_m = 0;
  bool has_last = false;
  for (core::TimeNs now_ns = 0; core::to_seconds(now_ns) < kDuration_s;) {
    world.cover(cover_at(now_ns) >= 0);
    for (const replay::SimulatedSample& sample : simulator.next().samples) {
      while (odometry.next_ns() <= sample.t_ns) {
        const core::OdometryReading read = odometry.next();
        arrival_ns = std::max(arrival_ns,
                              read.t_ns + core::from_seconds(random.uniform(0, robot.latency_s)));
        if (const auto spoiled = sensors.spoil(read))
          on_their_way.push_back(spoiled->arrived(arrival_ns));
      }
      while (!on_their_way.empty() && *on_their_way.front().arrival_ns <= sample.t_ns) {
        pipeline.add(on_their_way.front());
        on_their_way.pop_front();
      }
      now_ns = sample.t_ns;
      const core::ScanResult* scan = pipeline.add(replay::to_sample(sample));
      if (scan == nullptr) continue;
      const core::PoseEstimate& pose = scan->pose;
      const core::Pose2 truth = motion(pose.t_ns, 0);
      const int covered = cover_at(pose.t_ns);
      const double nees = has_pose(pose.state) || pose.state == core::PoseState::kPredicted
                              ? replay::normalised_error_squared(pose, truth)
                                    .value_or(std::numeric_limits<double>::infinity())
                              : 0;
      const bool is_wrong = !replay::is_right(pose.T_map_base, truth);
      if (covered < 0) ++result.scans;
      if (core::has_pose(pose.state)) {
        result.named += covered < 0 ? 1 : 0;
        result.wrong += is_wrong ? 1 : 0;
        if (pose.state == core::PoseState::kFix && !is_wrong) result.fixes.add(nees);
      } else if (pose.state == core::PoseState::kPredicted) {
        result.silent += is_wrong && nees > kNees999 ? 1 : 0;
        result.worst_sigma2 = std::max(result.worst_sigma2, nees);
      }
      if (cover >= 0 && covered != cover) {
        ++result.covers;
        if (has_last) {
          result.predicted.add(last_nees);
          result.mean_error_m += last_error_m;
        }
        has_last = false;
      }
      cover = covered;
      if (covered >= 0 && pose.state == core::PoseState::kPredicted) {
        has_last = true;
        last_nees = nees;
        last_error_m = replay::error_of(pose.T_map_base, truth).position_m;
      }
    }
  }
  result.mean_error_m /= static_cast<double>(std::max<std::size_t>(1, result.predicted.poses));
  return result;
}

}  // namespace cornerd::bench
