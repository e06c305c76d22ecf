// SPDX-License-Identifier: MIT
// cornerctl detect: the breakpoints of every turn, without a map.
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "tool/commands.hpp"
#include "tool/failure.hpp"
#include "tool/message_printer.hpp"
#include "tool/options.hpp"
#include "tool/output.hpp"
#include "tool/playback.hpp"

namespace cornerd::tool {

namespace {

struct DetectOptions {
  std::vector<std::filesystem::path> files;
  std::string method;
  SettingsOptions settings;
  std::vector<std::string> classes = {"BREAKPOINTS"};
  std::string wire = "auto";
};

void detect(DetectOptions& options) {
  if (!options.method.empty()) {
    options.settings.add_override("/detector/method=" + options.method);
  }
  const message::ClassSet classes = parse_classes(options.classes);
  if (classes.contains(message::MessageClass::kPose)) {
    throw UsageError("--classes: POSE needs a map; use replay");
  }
  const settings::Config config = options.settings.resolve(/*needs_map=*/false);

  Output output;
  MessagePrinter printer(output, classes, nullptr);
  core::Pipeline pipeline(nullptr, config.localizer());
  Playback playback(pipeline, [&](const core::Scan& turn, const core::TurnResult& result) {
    printer.print_turn(turn, result);
  });
  for (const std::filesystem::path& file : options.files) {
    playback.play(file, {parse_wire(options.wire), config.lidar.mount.inverted});
  }
  output.flush();
}

}  // namespace

void add_detect(CLI::App& program) {
  CLI::App* command = program.add_subcommand("detect", "breakpoints alone, no map needed");
  const auto options = std::make_shared<DetectOptions>();
  command->add_option("files", options->files, "recordings (.bin, .ndjson), one after another")
      ->required()
      ->type_name("FILE");
  command
      ->add_option("--method", options->method,
                   "how walls are found; without it, as the configuration says")
      ->check(CLI::IsMember({"altbd", "abd-iepf", "lt"}));
  options->settings.add_config(*command);
  command->add_option("--classes", options->classes, "messages to print: BREAKPOINTS, SCAN")
      ->delimiter(',')
      ->capture_default_str();
  add_wire_option(*command, options->wire);
  command->callback([options] { detect(*options); });
}

}  // namespace cornerd::tool
