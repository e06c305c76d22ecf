// SPDX-License-Identifier: MIT
// cornerctl detect: the breakpoints of every scan, without a map.
#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "baseline/wall_finders.hpp"
#include "tool/command_line/command.hpp"
#include "tool/command_line/failure.hpp"
#include "tool/command_line/output.hpp"
#include "tool/command_line/shared_options.hpp"
#include "tool/commands.hpp"
#include "tool/drawing/scan_drawing.hpp"
#include "tool/replay/message_printer.hpp"
#include "tool/replay/playback.hpp"

namespace cornerd::tool {

namespace {

struct DetectOptions {
  std::vector<std::filesystem::path> files;
  std::string method;
  SettingsOptions settings;
  std::vector<std::string> classes = {"BREAKPOINTS"};
  std::string wire = "auto";
  std::filesystem::path plot;
  std::size_t plotted_scan = 1;
};

void save_plot(const DetectOptions& options, const core::Scan& scan,
               const core::Detection& detection) {
  write_file(options.plot, draw_scan(scan, detection));
}

void detect(DetectOptions& options) {
  const message::ClassSet classes = parse_classes(options.classes);
  if (classes.contains(message::MessageClass::kPose) ||
      classes.contains(message::MessageClass::kMap)) {
    throw UsageError("--classes: POSE and MAP need a map; use replay");
  }
  CommandFiles files{.read = options.files, .written = {options.plot}, .output = {}};
  files.read.push_back(options.settings.config_file());
  guard_files(files);
  settings::Config config = options.settings.resolve(/*needs_map=*/false);
  config.detector.finder = baseline::wall_finder(options.method);

  Output output;
  MessagePrinter printer(output, classes, nullptr);
  core::Pipeline pipeline(nullptr, config.localizer());
  std::size_t scans = 0;
  Playback playback(pipeline, [&](const core::Scan& scan, const core::ScanResult& result) {
    printer.print_scan(scan, result);
    if (++scans == options.plotted_scan && !options.plot.empty()) {
      save_plot(options, scan, result.detection);
    }
  });
  for (const std::filesystem::path& file : options.files) {
    playback.play(file, {parse_wire(options.wire), config.lidar.mount.inverted});
  }
  output.flush();
  if (!options.plot.empty() && scans < options.plotted_scan) {
    throw Failure("--scan " + std::to_string(options.plotted_scan) + ": the recordings hold " +
                  std::to_string(scans) + " scans");
  }
}

}  // namespace

void add_detect(Command& program) {
  Command command = program.add_subcommand("detect", "detect breakpoints without a map");
  const auto options = std::make_shared<DetectOptions>();
  command.add_option("files", options->files, "recordings (.bin, .ndjson), one after another")
      .required()
      .type_name("FILE");
  command.add_option("--method", options->method, "detection of walls; default: altbd")
      .choices({"altbd", "altbd-printed", "abd-iepf", "lt"});
  options->settings.add_config(command);
  command.add_option("--classes", options->classes, "messages to print: BREAKPOINTS, SCAN")
      .delimiter(',')
      .capture_default_str();
  add_wire_option(command, options->wire);
  command.add_option("--plot", options->plot, "draw a scan with its walls and breakpoints, as SVG")
      .type_name("FILE");
  command.add_renamed("--turn", "--scan");
  command.add_option("--scan", options->plotted_scan, "number of the scan for --plot, from 1")
      .capture_default_str()
      .range(1, 100'000'000);
  command.callback([options] { detect(*options); });
}

}  // namespace cornerd::tool
