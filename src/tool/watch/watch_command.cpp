// SPDX-License-Identifier: MIT
// cornerctl watch: the daemon's messages as they come.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "settings/config.hpp"
#include "tool/command_line/command.hpp"
#include "tool/command_line/failure.hpp"
#include "tool/command_line/output.hpp"
#include "tool/command_line/shared_options.hpp"
#include "tool/commands.hpp"
#include "tool/watch/socket_client.hpp"

namespace cornerd::tool {

namespace {

using namespace std::chrono_literals;

// The daemon restarts in less than a second.
constexpr auto kFirstReconnectDelay = 200ms;
constexpr auto kMaxReconnectDelay = 5000ms;

struct WatchOptions {
  SettingsOptions settings;
  std::filesystem::path socket;
  std::vector<std::string> classes;
};

/// WATCH for the classes; empty for the daemon's default.
std::string request_for(const std::vector<std::string>& classes) {
  if (classes.empty()) return {};
  parse_classes(classes);
  std::string request = R"({"class":"WATCH","classes":[)";
  for (const std::string& name : classes) {
    if (request.back() != '[') request += ',';
    request += '"' + name + '"';
  }
  return request + "]}\n";
}

void watch(const WatchOptions& options) {
  const std::string request = request_for(options.classes);
  const std::filesystem::path socket =
      options.socket.empty() ? options.settings.resolve(/*needs_map=*/false).socket.pose
                             : options.socket;
  Output output(/*flush_each=*/true);
  SocketClient daemon;
  if (!daemon.connect(socket)) throw Failure(daemon.problem() + " (does cornerd run?)");

  for (auto retry = kFirstReconnectDelay;;) {
    if (request.empty() || daemon.send(request)) {
      for (std::string_view lines; !(lines = daemon.receive()).empty();) {
        output.write(lines);
        retry = kFirstReconnectDelay;
      }
    }
    std::fprintf(stderr, "cornerctl: %s: the daemon closed the connection; waiting for it\n",
                 socket.c_str());
    do {
      std::this_thread::sleep_for(retry);
      retry = std::min(retry * 2, kMaxReconnectDelay);
    } while (!daemon.connect(socket));
    std::fputs("cornerctl: the daemon is back\n", stderr);
  }
}

}  // namespace

void add_watch(Command& program) {
  Command command =
      program.add_subcommand("watch", "print the daemon's messages, one JSON object per line");
  const auto options = std::make_shared<WatchOptions>();
  command.add_option("--socket", options->socket, "default: the pose socket of the config")
      .type_name("PATH");
  options->settings.add_config(command);
  command
      .add_option("--classes", options->classes,
                  "messages to receive; default: POSE, STATUS, EVENT")
      .delimiter(',');
  command.callback([options] { watch(*options); });
}

}  // namespace cornerd::tool
