// SPDX-License-Identifier: MIT
#include "tool/simulate/simulation_options.hpp"

#include <cmath>
#include <cstdio>
#include <vector>

#include <CLI/CLI.hpp>

#include "replay/simulator/motion.hpp"
#include "replay/simulator/random_poses.hpp"
#include "tool/command_line/failure.hpp"
#include "tool/command_line/options.hpp"

namespace cornerd::tool {

namespace {

/// From the middle of a small robot to the nearest wall; nearer than 0.15 m an A1 sees nothing.
constexpr double kClearanceM = 0.15;

void warn_unless_indoors(const core::WallMap& map, const core::Vec2& point) {
  if (replay::is_indoors(map, point)) return;
  std::fprintf(stderr, "cornerctl: warning: %.12g,%.12g is %s of the map; the lidar sees little\n",
               point.x(), point.y(), map.is_solid(point) ? "inside a wall" : "outside the walls");
}

}  // namespace

void SimulationOptions::add_to(CLI::App& command) {
  command.add_option("--pose", pose, "the robot stands there (m, m, rad)")->type_name("X,Y,THETA");
  command.add_option("--places", places, "it visits so many random places")
      ->check(number_within(1, 1e6))
      ->type_name("N");
  command.add_option("--path", path, "it drives from point to point (m)")
      ->type_name("\"X,Y X,Y ...\"");
  command
      .add_option("--scenario", scenario,
                  "it drives there, in config/maps/flat-7.json: circuit-1, circuit-2, exploration")
      ->check(CLI::IsMember({"circuit-1", "circuit-2", "exploration"}));
  command.add_flag("--loop", loop, "and from the last point back to the first, for ever");
  command.add_option("--turns-each", scans_each, "turns of the lidar at each of the places")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command.add_option("--drive-speed", speed_m_s, "metres a second along the path")
      ->check(number_within(1e-3, 100))
      ->capture_default_str();
  command.add_option("--turn-speed", yaw_rate_rad_s, "radians a second on the spot")
      ->check(number_within(1e-3, 100))
      ->capture_default_str();
  command
      .add_option("--acceleration", acceleration_m_s2,
                  "metres a second squared at both ends of a way; 0: at once")
      ->check(number_within(0, 100));
  command
      .add_option("--turn-acceleration", yaw_acceleration_rad_s2,
                  "radians a second squared at both ends of a turn; 0: at once")
      ->check(number_within(0, 1000));
  command.add_option("--motor", motor_hz, "turns of the lidar a second")
      ->check(number_within(1, 15))
      ->capture_default_str();
  sensor.add_to(command);
  command.add_option("--seed", seed, "of all randomness")->capture_default_str();
}

replay::Motion SimulationOptions::motion(const core::WallMap& map) const {
  if (!pose.empty() + (places > 0) + !path.empty() + !scenario.empty() != 1) {
    throw UsageError("say where the robot is: one of --pose, --places, --path and --scenario");
  }
  if (!pose.empty()) {
    const core::Pose2 T_map_base = parse_pose(pose);
    warn_unless_indoors(map, T_map_base.translation());
    return replay::stand_still(T_map_base);
  }
  if (places > 0) {
    return replay::visit_poses(replay::random_poses(map, places, kClearanceM, seed), scans_each);
  }
  const std::vector<core::Vec2> points =
      scenario.empty() ? parse_points(path) : replay::find_scenario(scenario)->path;
  for (const core::Vec2& point : points) warn_unless_indoors(map, point);
  return replay::drive_path(points, drive());
}

replay::DriveConfig SimulationOptions::drive() const {
  replay::DriveConfig drive;
  drive.speed_m_s = speed_m_s;
  drive.yaw_rate_rad_s = yaw_rate_rad_s;
  drive.acceleration_m_s2 = acceleration_m_s2;
  drive.yaw_acceleration_rad_s2 = yaw_acceleration_rad_s2;
  drive.loop = loop || !scenario.empty();
  return drive;
}

std::int64_t SimulationOptions::default_scans() const {
  constexpr std::int64_t kShortRecording = 10;
  if (!scenario.empty()) {
    const double once_s = replay::drive_duration_s(replay::find_scenario(scenario)->path, drive());
    return std::llround(once_s * motor_hz);
  }
  return places > 0 ? static_cast<std::int64_t>(places) * scans_each : kShortRecording;
}

replay::SimulatorConfig SimulationOptions::simulator(rplidar::WireFormat wire,
                                                     const settings::LidarConfig& lidar) const {
  replay::SimulatorConfig config;
  config.sensor = sensor.model(lidar.noise);
  config.wire = wire;
  config.motor_hz = motor_hz;
  config.inverted = lidar.mount.inverted;
  config.seed = seed;
  return config;
}

}  // namespace cornerd::tool
