// SPDX-License-Identifier: MIT
// cornerctl watch: the daemon's messages as they come.
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "client/subscription.hpp"
#include "message/parsed_line.hpp"
#include "settings/config.hpp"
#include "tool/command_line/command.hpp"
#include "tool/command_line/failure.hpp"
#include "tool/command_line/output.hpp"
#include "tool/command_line/shared_options.hpp"
#include "tool/commands.hpp"
#include "tool/watch/message_text.hpp"

namespace cornerd::tool {

namespace {

constexpr std::chrono::seconds kLargestReconnectDelay{5};

struct WatchOptions {
  SettingsOptions settings;
  std::filesystem::path socket;
  std::vector<std::string> classes;
  std::string format = "json";
};

/// WATCH for the classes; empty for the daemon's default.
std::string request_for(const std::vector<std::string>& classes) {
  if (classes.empty()) return {};
  parse_classes(classes);
  std::string names;
  for (const std::string& name : classes) names += (names.empty() ? "" : ",") + name;
  return client::watch_request(names);
}

void watch(const WatchOptions& options) {
  const std::string request = request_for(options.classes);
  const std::filesystem::path socket =
      options.socket.empty() ? options.settings.resolve_for_daemon().socket.pose : options.socket;
  Output output(/*flush_each=*/true);
  client::Subscription daemon(socket, request, kLargestReconnectDelay);
  std::string_view line;
  if (daemon.wait(line) == client::Event::kLost) {
    throw Failure(daemon.problem() + " (does cornerd run?)");
  }
  for (std::string with_newline;;) {
    const client::Event event = daemon.wait(line);
    if (event == client::Event::kMessage) {
      if (options.format == "text") {
        output.write(message_text(message::parse_line(line)));
        continue;
      }
      with_newline.assign(line).push_back('\n');
      output.write(with_newline);
    } else if (event == client::Event::kConnected) {
      std::fputs("cornerctl: the daemon is back\n", stderr);
    } else {
      std::fprintf(stderr, "cornerctl: %s; waiting for it\n", daemon.problem().c_str());
    }
  }
}

}  // namespace

void add_watch(Command& program) {
  Command command = program.add_subcommand("watch", "print the daemon's messages as they come");
  const auto options = std::make_shared<WatchOptions>();
  command.add_option("--socket", options->socket, "default: the pose socket of the config")
      .type_name("PATH");
  options->settings.add_config(command, kDaemonsConfig);
  command
      .add_option("--classes", options->classes,
                  "messages to receive; default: POSE, STATUS, EVENT")
      .delimiter(',');
  command.add_option("--format", options->format, "json: as on the socket; text: for a person")
      .choices({"json", "text"})
      .capture_default_str();
  command.callback([options] { watch(*options); });
}

}  // namespace cornerd::tool
