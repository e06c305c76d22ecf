// SPDX-License-Identifier: MIT
// cornerctl simulate: a recording of a simulated robot in a map, with its truth.
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "replay/recording_writer.hpp"
#include "replay/simulator/simulated_recording.hpp"
#include "settings/map_file.hpp"
#include "tool/command_line/command.hpp"
#include "tool/command_line/failure.hpp"
#include "tool/command_line/output.hpp"
#include "tool/command_line/shared_options.hpp"
#include "tool/commands.hpp"
#include "tool/simulate/odometry_options.hpp"
#include "tool/simulate/simulation_options.hpp"

namespace cornerd::tool {

namespace {

struct SimulateOptions {
  SettingsOptions settings;
  SimulationOptions simulation;
  OdometryOptions odometry;
  std::int64_t scans = 0;
  std::string wire = "express";
  std::filesystem::path output;
  std::filesystem::path truth;
};

void simulate(const SimulateOptions& options) {
  const settings::Config settings = options.settings.resolve(/*needs_map=*/true);
  guard_files(
      {.read = {settings.map, options.settings.config_file(), options.simulation.sensor.noise},
       .written = {options.output, options.truth},
       .output = {}});
  const SimulationOptions& simulation = options.simulation;

  replay::SimulatedRecordingConfig config;
  config.simulator = simulation.simulator(*parse_wire(options.wire).format, settings.lidar);
  config.T_base_lidar = settings.localizer().T_base_lidar;
  config.scans = options.scans > 0 ? options.scans : simulation.default_scans();
  config.robot = options.odometry.robot(settings.odometry);
  const OdometryOptions::Times covered = options.odometry.covered_times();
  config.covered_from_ns = covered.from_ns;
  config.covered_to_ns = covered.to_ns;

  if (config.robot && simulation.places > 0) {
    throw UsageError("--odometry: not available with --places: the robot must drive or stand");
  }
  const bool has_times = replay::RecordingWriter::has_lines(options.output);
  if (config.robot && !has_times) {
    throw UsageError("--odometry needs a recording with times: -o FILE.ndjson");
  }
  if (!options.truth.empty() && !has_times && !simulation.stands_still()) {
    throw UsageError("--truth of a robot that moves needs a recording with times: -o FILE.ndjson");
  }
  const auto [world, motion] = simulation.place(settings::load_map(settings.map), settings.lidar);
  Replacement output(options.output);
  Replacement truth_output(options.truth);
  replay::RecordingWriter recording(output.path());
  std::optional<replay::TruthWriter> truth;
  if (!options.truth.empty()) truth.emplace(truth_output.path());
  const replay::SimulatedRecordingSummary summary =
      simulate_recording(world, motion, config, recording, truth ? &*truth : nullptr);
  output.commit();
  truth_output.commit();
  std::fprintf(stderr, "%s: %lld scans in %.1f s, %llu samples, %.0f %% of them with a return\n",
               options.output.c_str(), static_cast<long long>(config.scans), summary.duration_s,
               static_cast<unsigned long long>(summary.samples),
               100.0 * static_cast<double>(summary.returns) / static_cast<double>(summary.samples));
}

}  // namespace

void add_simulate(Command& program) {
  Command command =
      program.add_subcommand("simulate", "record a simulated robot in a map, with its truth");
  const auto options = std::make_shared<SimulateOptions>();
  options->settings.add_config(command);
  options->settings.add_map(command);
  options->simulation.add_to(command);
  options->odometry.add_to(command);
  command
      .add_option("--covered", options->odometry.covered,
                  "the lidar is covered between these times (s)")
      .type_name("FROM,TO");
  command
      .add_option("--scans", options->scans,
                  "number of scans; default: all places, once along the path, or 10 at rest")
      .positive()
      .type_name("N");
  command.add_renamed("--turns", "--scans");
  command.add_option("--wire", options->wire, "standard, express or ultra")
      .choices({"standard", "express", "ultra"})
      .capture_default_str();
  command
      .add_option("-o,--output", options->output,
                  "the recording: .ndjson with times, .bin bytes only")
      .required()
      .type_name("FILE");
  command.add_option("--truth", options->truth, "write the true poses, for replay --truth")
      .type_name("FILE");
  command.callback([options] { simulate(*options); });
}

}  // namespace cornerd::tool
