// SPDX-License-Identifier: MIT
// cornerctl monitor: the daemon's messages as a picture.
#include <filesystem>
#include <memory>

#include "settings/map_file.hpp"
#include "tool/command_line/command.hpp"
#include "tool/command_line/failure.hpp"
#include "tool/command_line/shared_options.hpp"
#include "tool/commands.hpp"
#include "tool/monitor/monitor.hpp"

namespace cornerd::tool {

namespace {

struct MonitorOptions {
  SettingsOptions settings;
  std::filesystem::path socket;
};

void monitor(MonitorOptions& options) {
  if (terminal_is_dumb()) {
    throw Failure("monitor: TERM=dumb has no cursor control; use cornerctl watch");
  }
  options.settings.use_daemons_config();
  const settings::Config config = options.settings.resolve(/*needs_map=*/false);
  std::shared_ptr<const core::WallMap> map;
  if (!config.map.empty()) map = settings::load_map(config.map);
  const Scene scene{map.get(), config.localizer().T_base_lidar};
  ViewChoice choice;
  choice.unicode = terminal_has_unicode();
  Monitor(options.socket.empty() ? config.socket.pose : options.socket, scene, choice,
          terminal_has_colours())
      .run();
}

}  // namespace

void add_monitor(Command& program) {
  Command command = program.add_subcommand(
      "monitor",
      "a live view in the terminal: map, scan, corners, pose, rates, faults and remedies; "
      "q ends it");
  const auto options = std::make_shared<MonitorOptions>();
  command.add_option("--socket", options->socket, "the daemon's socket; default: the config's")
      .type_name("PATH");
  options->settings.add_config(command, kDaemonsConfig);
  options->settings.add_map(command);
  command.callback([options] { monitor(*options); });
}

}  // namespace cornerd::tool
