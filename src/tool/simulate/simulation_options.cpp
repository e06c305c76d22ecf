// SPDX-License-Identifier: MIT
#include "tool/simulate/simulation_options.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>
#include <vector>

#include "core/geometry/angle.hpp"
#include "replay/simulator/clutter.hpp"
#include "replay/simulator/map_error.hpp"
#include "replay/simulator/motion.hpp"
#include "replay/simulator/random_poses.hpp"
#include "replay/simulator/scanned_path.hpp"
#include "tool/command_line/command.hpp"
#include "tool/command_line/failure.hpp"
#include "tool/command_line/shared_options.hpp"

namespace cornerd::tool {

namespace {

/// Smallest distance from the robot to a wall: the minimum range of an A1.
constexpr double kClearanceM = 0.15;

constexpr std::uint64_t kMapErrorSeed = 0x8BB84B93962EACC9u;
constexpr std::uint64_t kEndErrorSeed = 0x4B33A62ED433D4A3u;
constexpr std::uint64_t kClutterSeed = 0x2D358DCCAA6C78A5u;

void warn_unless_indoors(const core::WallMap& map, const core::Vec2& point) {
  if (replay::is_indoors(map, point)) return;
  std::fprintf(stderr,
               "cornerctl: warning: %.12g,%.12g is %s of the map; few returns are expected\n",
               point.x(), point.y(), map.is_solid(point) ? "inside a wall" : "outside the walls");
}

void warn_of_walls(const core::WallMap& map, const std::vector<core::Vec2>& stops) {
  for (std::size_t i = 1; i < stops.size(); ++i) {
    const core::Vec2 way = stops[i] - stops[i - 1];
    if (map.range_along(stops[i - 1], core::angle_of(way), way.norm()) == 0) continue;
    std::fprintf(
        stderr, "cornerctl: warning: the way from %.12g,%.12g to %.12g,%.12g goes through a wall\n",
        stops[i - 1].x(), stops[i - 1].y(), stops[i].x(), stops[i].y());
  }
}

}  // namespace

void SimulationOptions::add_to(Command& command) {
  command.add_option("--pose", pose, "pose of the robot at rest (m, m, rad)")
      .type_name("X,Y,THETA");
  command.add_option("--places", places, "number of random poses that the robot visits")
      .within(1, 1e6)
      .type_name("N");
  command.add_option("--path", path, "path of the robot (m)").type_name("\"X,Y X,Y ...\"");
  command
      .add_option("--scenario", scenario,
                  "path in config/maps/flat-7.json: circuit-1, circuit-2, exploration")
      .choices({"circuit-1", "circuit-2", "exploration"});
  command.add_flag("--loop", loop, "return to the first point of the path and repeat it");
  command.add_option("--scans-each", scans_each, "scans at each pose of --places")
      .positive()
      .capture_default_str();
  command.add_option("--drive-speed", speed_m_s, "speed along the path (m/s)")
      .within(1e-3, 100)
      .capture_default_str();
  command.add_option("--rotation-speed", yaw_rate_rad_s, "yaw rate of rotations in place (rad/s)")
      .within(1e-3, 100)
      .capture_default_str();
  command
      .add_option("--acceleration", acceleration_m_s2,
                  "acceleration at both ends of a straight segment (m/s^2); 0: unlimited")
      .within(0, 100);
  command
      .add_option("--rotation-acceleration", yaw_acceleration_rad_s2,
                  "angular acceleration at both ends of a rotation (rad/s^2); 0: unlimited")
      .within(0, 1000);
  command.add_option("--motor", motor_hz, "scan rate (Hz); default: the lidar's, 7.3 of an A1")
      .within(1, 15);
  command
      .add_option("--map-error", map_error_m,
                  "standard deviation of each wall's displacement across itself in the simulated "
                  "place (m); the map stays as it is")
      .within(0, 0.5)
      .type_name("SIGMA_M");
  command
      .add_option("--end-error", end_error_m,
                  "standard deviation of the displacement of each wall's ends in x and in y (m), "
                  "which turns walls; ends that meet stay together")
      .within(0, 0.5)
      .type_name("SIGMA_M");
  command
      .add_option("--clutter", clutter,
                  "share of the rays along the path that stop at unmapped obstacles: posts, legs "
                  "of furniture, boxes, closed doors; none within 0.25 m of the path")
      .within(0, 0.6)
      .type_name("SHARE");
  sensor.add_to(command);
  command.add_option("--seed", seed, "seed of the random numbers").capture_default_str();
  command.add_renamed("--turns-each", "--scans-each");
  command.add_renamed("--turn-speed", "--rotation-speed");
  command.add_renamed("--turn-acceleration", "--rotation-acceleration");
}

replay::Motion SimulationOptions::motion(const core::WallMap& world) const {
  if (!pose.empty() + (places > 0) + !path.empty() + !scenario.empty() != 1) {
    throw UsageError("give exactly one of --pose, --places, --path and --scenario");
  }
  if (!pose.empty()) {
    const core::Pose2 T_map_base = parse_pose(pose);
    warn_unless_indoors(world, T_map_base.translation());
    return replay::stand_still(T_map_base);
  }
  if (places > 0) {
    return replay::visit_poses(replay::random_poses(world, places, kClearanceM, seed), scans_each);
  }
  std::vector<core::Vec2> stops = points();
  for (const core::Vec2& point : stops) warn_unless_indoors(world, point);
  const replay::DriveConfig config = drive();
  replay::Motion motion = replay::drive_path(stops, config);
  if (config.loop) stops.push_back(stops.front());
  warn_of_walls(world, stops);
  return motion;
}

std::vector<core::Vec2> SimulationOptions::points() const {
  return scenario.empty() ? parse_points(path) : replay::find_scenario(scenario)->path;
}

SimulatedPlace SimulationOptions::place(std::shared_ptr<const core::WallMap> map,
                                        const settings::LidarConfig& lidar) const {
  SimulatedPlace place{std::move(map), {}};
  core::FloorPlan plan = place.world->plan();
  if (map_error_m > 0) plan = replay::with_map_error(plan, map_error_m, seed ^ kMapErrorSeed);
  if (end_error_m > 0) plan = replay::with_end_error(plan, end_error_m, seed ^ kEndErrorSeed);
  if (map_error_m > 0 || end_error_m > 0) {
    place.world = std::make_shared<const core::WallMap>(plan);
  }
  place.motion = motion(*place.world);
  if (clutter <= 0) return place;
  const core::Pose2 T_base_lidar{lidar.mount.x_m, lidar.mount.y_m, lidar.mount.theta_rad};
  const replay::Clutter obstacles = replay::place_clutter(
      *place.world, replay::scanned_path(place.motion, T_base_lidar, scans_of_motion(), rate_hz()),
      simulator(rplidar::WireFormat::kStandard, lidar).sensor, clutter, seed ^ kClutterSeed);
  std::fprintf(stderr, "cornerctl: %zu unmapped obstacles stop %.0f %% of the rays\n",
               obstacles.obstacles, 100 * obstacles.share);
  plan.walls.insert(plan.walls.end(), obstacles.walls.begin(), obstacles.walls.end());
  place.world = std::make_shared<const core::WallMap>(std::move(plan));
  return place;
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
  const bool moves = places > 0 || !path.empty() || !scenario.empty();
  return moves ? scans_of_motion() : kShortRecording;
}

std::int64_t SimulationOptions::scans_of_motion() const {
  if (!pose.empty()) return 1;
  if (places > 0) return static_cast<std::int64_t>(places) * scans_each;
  return std::max<std::int64_t>(
      1, std::llround(replay::drive_duration_s(points(), drive()) * rate_hz()));
}

replay::SimulatorConfig SimulationOptions::simulator(rplidar::WireFormat wire,
                                                     const settings::LidarConfig& lidar) const {
  replay::SimulatorConfig config;
  config.sensor = sensor.model(lidar.noise);
  config.sensor.field_of_view.centre_rad = -lidar.mount.theta_rad;
  config.wire = wire;
  config.motor_hz = rate_hz();
  config.inverted = lidar.mount.inverted;
  config.seed = seed;
  return config;
}

namespace {

/// Measured on standard-mode recordings of A1s in living rooms: 29-51 % of the nodes empty, in
/// stretches of about six; 3-6 % step back, most of them after empty ones; 0.18 degrees of bearing
/// noise (calibrate noise, one recording). Assumed: the outliers, and the beam, which stands on few
/// edges of another RPLidar (16-47 % mixed); the A1's 13 edges showed none.
void set_recorded_errors(replay::SensorModel& model) {
  model.missing = 0.38;
  model.missing_run = 6;
  model.outliers = 0.005;
  model.beam_width_rad = core::radians(0.3);
  model.backward = 0.005;
  model.noise.bearing_rad = core::radians(0.18);
}

}  // namespace

void SensorOptions::add_to(Command& command) {
  command.add_flag("--real", real,
                   "missing runs, backward angles, mixed pixels and outliers as in recordings of "
                   "A1s; other options override");
  command
      .add_option(
          "--noise", noise,
          "the lidar's noise, a file of calibrate noise; default: lidar.noise of the config")
      .type_name("FILE");
  command
      .add_option("--sigma-floor", floor_m, "standard deviation of a range: the larger of this (m)")
      .within(0, 1);
  command.add_option("--sigma-share", share, "and this share of the range; overrides --noise")
      .within(0, 1);
  command.add_option("--bearing-noise", bearing_deg, "standard deviation of a bearing (degrees)")
      .within(0, 5);
  command.add_option("--missing", missing, "share of samples without a return").within(0, 1);
  command.add_option("--missing-run", missing_run, "mean length of a run of missing samples")
      .within(1, 1e6);
  command.add_option("--outliers", outliers, "share of outliers").within(0, 1);
  command.add_option("--beam", beam_deg, "width of the beam (degrees): mixed pixels at edges")
      .within(0, 10);
  command
      .add_option("--fov", fov_deg,
                  "field of view, centred ahead of the robot (degrees): no returns outside")
      .within(20, 360);
  command
      .add_option("--backward", backward,
                  "share of standard nodes that arrive after the next one, with a backward step of "
                  "the angle")
      .within(0, 0.4);
  command.add_option("--range-scale", range_scale, "bias: factor of every range").within(0.9, 1.1);
  command.add_option("--range-offset", range_offset_m, "bias: added to every range (m)")
      .within(-0.1, 0.1);
  command
      .add_option("--eccentricity", eccentricity_deg,
                  "bias: largest bearing error by the eccentricity of the angle disc (degrees)")
      .within(0, 3);
  command
      .add_option("--eccentricity-phase", eccentricity_phase_deg,
                  "device angle at which that error is zero and growing (degrees)")
      .within(-360, 360);
}

replay::SensorModel SensorOptions::model(const settings::NoiseConfig& configured) const {
  replay::SensorModel model;
  const settings::NoiseConfig given = noise.empty() ? configured : settings::load_noise(noise);
  model.noise = given.sensor;
  model.wall = given.wall;
  if (floor_m || share) {
    model.noise.table = {};
    model.wall = {};
  }
  model.noise.floor_m = floor_m.value_or(model.noise.floor_m);
  model.noise.share = share.value_or(model.noise.share);
  if (real) set_recorded_errors(model);
  if (bearing_deg) model.noise.bearing_rad = core::radians(*bearing_deg);
  model.missing = missing.value_or(model.missing);
  model.missing_run = missing_run.value_or(model.missing_run);
  model.outliers = outliers.value_or(model.outliers);
  if (beam_deg) model.beam_width_rad = core::radians(*beam_deg);
  if (fov_deg) model.field_of_view.width_rad = core::radians(*fov_deg);
  model.backward = backward.value_or(model.backward);
  model.range_scale = range_scale.value_or(model.range_scale);
  model.range_offset_m = range_offset_m.value_or(model.range_offset_m);
  if (eccentricity_deg) model.eccentricity_rad = core::radians(*eccentricity_deg);
  if (eccentricity_phase_deg) model.eccentricity_phase_rad = core::radians(*eccentricity_phase_deg);
  return model;
}

}  // namespace cornerd::tool
