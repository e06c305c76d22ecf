// SPDX-License-Identifier: MIT
// cornerctl replay: runs the daemon's pipeline on recordings. Output is deterministic.
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "settings/map_file.hpp"
#include "tool/command_line/command.hpp"
#include "tool/command_line/failure.hpp"
#include "tool/command_line/output.hpp"
#include "tool/command_line/shared_options.hpp"
#include "tool/commands.hpp"
#include "tool/replay/error_statistics.hpp"
#include "tool/replay/message_printer.hpp"
#include "tool/replay/playback.hpp"
#include "tool/replay/truth.hpp"

namespace cornerd::tool {

namespace {

using message::MessageClass;

struct ReplayOptions {
  std::vector<std::filesystem::path> files;
  SettingsOptions settings;
  std::vector<std::string> classes = {"POSE", "STATUS"};
  std::string speed = "max";
  std::string wire = "auto";
  std::filesystem::path odometry;
  std::filesystem::path truth;
  bool independent = false;
};

void replay(ReplayOptions& options) {
  const message::ClassSet classes = parse_classes(options.classes);
  const std::optional<double> speed = parse_speed(options.speed);
  const bool needs_map = classes.contains(MessageClass::kPose) ||
                         classes.contains(MessageClass::kMap) || !options.truth.empty();
  settings::Config config =
      needs_map ? options.settings.resolve_with_map() : options.settings.resolve(false);
  if (!options.odometry.empty()) config.odometry.core.enabled = true;
  // Faults and the online calibration of the odometry need poses, hence the map.
  const bool judges = classes.contains(MessageClass::kStatus) ||
                      (classes.contains(MessageClass::kOdom) && config.odometry.core.enabled);
  const bool uses_map = needs_map || (judges && !config.map.empty());
  // Where scans fit nowhere, the last STATUS says whether another map fits.
  if (uses_map && classes.contains(MessageClass::kStatus)) {
    for (const settings::NamedMap& other : config.maps) {
      if (other.file != config.map) settings::load_map(other.file);
    }
  }
  const auto map = uses_map ? settings::load_map(config.map) : nullptr;
  std::optional<Truth> truth;
  if (!options.truth.empty()) truth = Truth::load(options.truth);

  Output output(/*flush_each=*/speed.has_value());
  MessagePrinter printer(output, classes, map.get(), &config);
  core::LocalizerConfig localizer = config.localizer();
  if (options.independent) localizer.search_nodes_per_scan = core::kWholeSearch;
  core::Pipeline pipeline(map, localizer);
  ErrorStatistics errors;
  ErrorStatistics intermediate_errors;
  std::optional<Pace> pace;

  const auto on_scan = [&](const core::Scan& scan, const core::ScanResult& result) {
    printer.print_scan(scan, result);
    if (!truth) return;
    const std::optional<core::Pose2> T_map_base = truth->at(result.pose.t_ns);
    T_map_base ? errors.add(result.pose, *T_map_base) : errors.add_unknown();
  };
  drivers::StreamCounters counters;
  core::TimeNs t_ns = 0;
  const auto on_piece = [&](core::TimeNs piece_ns, const drivers::StreamCounters& so_far) {
    t_ns = piece_ns;
    counters = so_far;
    if (pace) pace->wait_until(t_ns);
    printer.print_status_when_due(t_ns, counters);
  };

  Playback playback(pipeline, on_scan, on_piece);
  playback.set_independent(options.independent);
  playback.set_on_prediction([&](const core::PoseEstimate& pose) {
    printer.print_pose(pose);
    if (!truth) return;
    if (const auto T_map_base = truth->at(pose.t_ns)) intermediate_errors.add(pose, *T_map_base);
  });
  core::OdometryPose odom;
  playback.set_on_reading([&](const core::OdometryReading& reading) {
    printer.note(reading);
    const auto& moved = pipeline.localizer().measured_motion();
    if (!moved) return;
    odom.add(*moved);
    printer.print_odom(odom);
  });
  playback.set_on_refusal([&](const message::RequestError& error) { printer.refuse(error); });
  if (!options.odometry.empty()) playback.set_odometry(load_odometry(options.odometry));
  const replay::RecordingOptions recording{parse_wire(options.wire), config.lidar.mount.inverted};
  for (const std::filesystem::path& file : options.files) {
    if (speed) pace.emplace(*speed);
    printer.begin_recording();
    playback.play(file, recording);
    printer.print_status(t_ns, counters, drivers::LidarState::kEnded);
  }
  output.flush();
  if (truth) std::fputs(errors.report().c_str(), stderr);
  if (intermediate_errors.scans() > 0) {
    std::fprintf(stderr, "between the scans\n%s", intermediate_errors.report("poses").c_str());
  }
}

}  // namespace

void add_replay(Command& program) {
  Command command = program.add_subcommand(
      "replay", "run the daemon's pipeline on recordings and print its messages");
  const auto options = std::make_shared<ReplayOptions>();
  command.add_option("files", options->files, "recordings (.bin, .ndjson), one after another")
      .required()
      .type_name("FILE");
  options->settings.add_config(command, kDaemonsConfig);
  options->settings.add_map(command);
  command.add_option("--classes", options->classes, "messages to print")
      .delimiter(',')
      .capture_default_str();
  command.add_option("--speed", options->speed, "max, or a multiple of real time")
      .capture_default_str();
  add_wire_option(command, options->wire);
  command
      .add_option("--odometry", options->odometry,
                  "file of ODOMETRY lines, in place of those of the recordings, which are used "
                  "unless odometry.source is none")
      .type_name("FILE");
  command
      .add_option("--truth", options->truth, "true poses: print error statistics on standard error")
      .type_name("FILE");
  command.add_flag("--independent", options->independent, "reset the localizer after every scan");
  command.callback([options] { replay(*options); });
}

}  // namespace cornerd::tool
