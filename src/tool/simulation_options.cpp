// SPDX-License-Identifier: MIT
#include "tool/simulation_options.hpp"

#include <CLI/CLI.hpp>

#include "replay/simulator/motion.hpp"
#include "replay/simulator/places.hpp"
#include "tool/failure.hpp"
#include "tool/options.hpp"

namespace cornerd::tool {

namespace {

/// From the middle of a small robot to the nearest wall; nearer than 0.15 m an A1 sees nothing.
constexpr double kClearanceM = 0.15;

}  // namespace

void SimulationOptions::add_to(CLI::App& command) {
  command.add_option("--pose", pose, "the robot stands there (m, m, rad)")->type_name("X,Y,THETA");
  command.add_option("--places", places, "it visits so many random places")->type_name("N");
  command.add_option("--path", path, "it drives from point to point (m)")
      ->type_name("\"X,Y X,Y ...\"");
  command.add_flag("--loop", loop, "and from the last point back to the first, for ever");
  command.add_option("--turns-each", turns_each, "turns of the lidar at each of the places")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command.add_option("--drive-speed", speed_m_s, "metres a second along the path")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command.add_option("--turn-speed", yaw_rate_rad_s, "radians a second on the spot")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command.add_option("--motor", motor_hz, "turns of the lidar a second")
      ->check(CLI::Range(1.0, 15.0))
      ->capture_default_str();
  command.add_option("--missing", missing, "share of samples without a return")
      ->check(CLI::Range(0.0, 1.0));
  command.add_option("--seed", seed, "of all randomness")->capture_default_str();
}

replay::Motion SimulationOptions::motion(const core::WallMap& map) const {
  if (!pose.empty() + (places > 0) + !path.empty() != 1) {
    throw UsageError("say where the robot is: one of --pose, --places and --path");
  }
  if (!pose.empty()) return replay::stand_still(parse_pose(pose));
  if (places > 0) {
    return replay::visit_places(replay::random_places(map, places, kClearanceM, seed), turns_each);
  }
  replay::DriveConfig drive;
  drive.speed_m_s = speed_m_s;
  drive.yaw_rate_rad_s = yaw_rate_rad_s;
  drive.loop = loop;
  return replay::drive_path(parse_points(path), drive);
}

std::int64_t SimulationOptions::usual_turns() const {
  constexpr std::int64_t kShortRecording = 10;
  return places > 0 ? static_cast<std::int64_t>(places) * turns_each : kShortRecording;
}

replay::SimulatorConfig SimulationOptions::simulator(rplidar::WireFormat wire,
                                                     bool inverted) const {
  replay::SimulatorConfig config;
  if (missing >= 0) config.sensor.missing = missing;
  config.wire = wire;
  config.motor_hz = motor_hz;
  config.inverted = inverted;
  config.seed = seed;
  return config;
}

}  // namespace cornerd::tool
