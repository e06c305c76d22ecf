// SPDX-License-Identifier: MIT
// cornerctl emulate: a lidar on a pseudo-terminal, for cornerd or any other client to open.
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "replay/emulator/firmware.hpp"
#include "replay/emulator/make_emulator.hpp"
#include "replay/emulator/pty_emulator.hpp"
#include "replay/emulator/recorded_scene.hpp"
#include "replay/recording_writer.hpp"
#include "settings/map_file.hpp"
#include "tool/command_line/command.hpp"
#include "tool/command_line/failure.hpp"
#include "tool/command_line/output.hpp"
#include "tool/command_line/shared_options.hpp"
#include "tool/command_line/stop_signal.hpp"
#include "tool/commands.hpp"
#include "tool/simulate/odometry_feed.hpp"
#include "tool/simulate/odometry_options.hpp"
#include "tool/simulate/simulation_options.hpp"

namespace cornerd::tool {

namespace {

struct EmulateOptions {
  std::filesystem::path recording;
  SettingsOptions settings;
  SimulationOptions simulation;
  std::string wire = "auto";
  std::string model = "a1";
  std::string firmware = "1.29";
  double spin_up_s = 0;
  std::filesystem::path link;
  std::filesystem::path truth;
  OdometryOptions odometry;
};

/// A scene, and the motion in it where there is one.
struct World {
  std::unique_ptr<replay::Scene> scene;
  replay::Motion motion;
};

World make_world(const EmulateOptions& options, const settings::Config& config) {
  if (!options.recording.empty()) {
    if (!options.truth.empty()) throw UsageError("--truth: not available for a recording");
    if (options.odometry.enabled) throw UsageError("--odometry: not available for a recording");
    if (options.simulation.changes_map()) {
      throw UsageError(
          "--map-error, --end-error, --clutter: not available for a recording; give --map");
    }
    const replay::RecordingOptions how{parse_wire(options.wire), config.lidar.mount.inverted};
    return {std::make_unique<replay::RecordedScene>(options.recording, how), {}};
  }
  if (options.simulation.places > 0 && options.odometry.enabled) {
    throw UsageError("--odometry: not available with --places: the robot must drive or stand");
  }
  if (options.simulation.places > 0 && !options.truth.empty()) {
    throw UsageError("--truth: not available with --places: the robot jumps between scans");
  }
  const auto [world, motion] =
      options.simulation.place(settings::load_map(config.map), config.lidar);
  return {std::make_unique<replay::MapScene>(world, motion, config.localizer().T_base_lidar),
          motion};
}

void emulate(EmulateOptions options) {
  const replay::Firmware* firmware = replay::find_firmware(options.firmware);
  if (firmware == nullptr) throw UsageError("--firmware: must be 1.29, 1.24 or 1.17");
  const drivers::LidarModel& model = *drivers::find_lidar_model(options.model);
  settings::Config config = options.settings.resolve(/*needs_map=*/options.recording.empty());
  // The config's noise is that of its driver's first model.
  if (&model != drivers::first_lidar_model(config.lidar.driver)) {
    config.lidar.noise.sensor = model.noise();
  }
  if (!options.simulation.motor_hz) options.simulation.motor_hz = model.rate_hz;
  guard_files(
      {.read = {options.recording, options.settings.config_file(), options.simulation.sensor.noise,
                options.recording.empty() ? config.map : std::filesystem::path()},
       .written = {options.truth, options.link},
       .output = {}});

  World world = make_world(options, config);

  replay::EmulatorConfig device;
  device.firmware = firmware;
  device.spin_up_s = options.spin_up_s;
  replay::SimulatorConfig simulator =
      options.simulation.simulator(rplidar::WireFormat::kStandard, config.lidar);
  simulator.sensor.min_range_m = model.min_range_m;
  simulator.sensor.max_range_m = model.max_range_m;
  replay::PtyEmulator emulator(
      replay::make_emulator(model, std::move(world.scene), simulator, device), options.link,
      model.baud);
  emulator.expect_speed(model.baud);

  std::optional<replay::TruthWriter> truth;
  if (!options.truth.empty()) truth.emplace(options.truth);
  std::optional<OdometryFeed> odometry;
  if (const auto robot = options.odometry.robot(config.odometry)) {
    odometry.emplace(config.socket.control,
                     replay::SimulatedOdometry(world.motion, *robot, simulator.seed));
  }
  emulator.set_on_time([&](core::TimeNs t_ns, core::TimeNs unix_ns) {
    if (odometry) odometry->send_until(t_ns, unix_ns);
    if (!truth) return;
    truth->add(unix_ns, world.motion(t_ns, 0));
    truth->flush();  // so that it can be compared while it is written
  });

  // Before the path is printed: its reader may send a signal at once.
  const StopSignal stop_signal;
  std::stop_source stop;
  const std::jthread waiter([&](const std::stop_token& over) {
    while (!over.stop_requested()) {
      if (stop_signal.wait(std::chrono::milliseconds(50))) stop.request_stop();
    }
  });
  Output output(/*flush_each=*/true);
  output.write((options.link.empty() ? emulator.path() : options.link).string() + "\n");
  emulator.run(stop.get_token());
}

}  // namespace

void add_emulate(Command& program) {
  Command command = program.add_subcommand(
      "emulate", "a lidar on a pseudo-terminal, whose path is printed, until interrupted");
  const auto options = std::make_shared<EmulateOptions>();
  command
      .add_option("file", options->recording, "replay this recording; default: simulate in the map")
      .type_name("FILE");
  options->settings.add_config(command);
  options->settings.add_map(command);
  options->simulation.add_to(command);
  add_wire_option(command, options->wire);
  std::vector<std::string> models;
  for (const drivers::LidarModel& model : drivers::kLidarModels) models.emplace_back(model.name);
  command.add_option("--model", options->model, "the lidar").choices(models).capture_default_str();
  command.add_option("--firmware", options->firmware, "of an a1: 1.29, 1.24 or 1.17")
      .capture_default_str();
  command.add_option("--spin-up", options->spin_up_s, "duration of an RPLidar's spin-up (s)")
      .within(0, 3600);
  command.add_option("--link", options->link, "a symbolic link to the pseudo-terminal")
      .type_name("PATH");
  options->odometry.add_to(command);
  command.add_option("--truth", options->truth, "write the true poses, in UNIX time")
      .type_name("FILE");
  command.callback([options] { emulate(*options); });
}

}  // namespace cornerd::tool
