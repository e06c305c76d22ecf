// SPDX-License-Identifier: MIT
// cornerctl status, set-pose, relocalize: one request, one answer.
#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

#include "client/connection.hpp"
#include "message/json_text.hpp"
#include "message/parsed_line.hpp"
#include "settings/config.hpp"
#include "tool/command_line/command.hpp"
#include "tool/command_line/failure.hpp"
#include "tool/command_line/output.hpp"
#include "tool/command_line/shared_options.hpp"
#include "tool/commands.hpp"
#include "tool/drawing/text_table.hpp"
#include "tool/watch/message_text.hpp"

namespace cornerd::tool {

namespace {

struct RequestOptions {
  SettingsOptions settings;
  std::filesystem::path socket;
  std::string format = "json";
  std::string pose;
};

/// Sends a request with the id 1 and calls take(line) for what comes until its answer. Throws
/// Failure with the daemon's reason, or if it does not answer.
template <typename Take>
void ask(const std::filesystem::path& socket, const std::string& request, Take&& take) {
  constexpr std::chrono::seconds kAnswerTime{5};
  client::Connection daemon;
  if (!daemon.connect(socket) || !daemon.send(request)) {
    throw Failure(daemon.problem() + " (does cornerd run?)");
  }
  const auto end = std::chrono::steady_clock::now() + kAnswerTime;
  for (std::string_view line;;) {
    const auto left =
        std::chrono::ceil<std::chrono::milliseconds>(end - std::chrono::steady_clock::now());
    if (left.count() <= 0) throw Failure(socket.string() + ": the daemon does not answer");
    const client::Received received = daemon.receive(line, left);
    if (received == client::Received::kEnd) {
      throw Failure(socket.string() + ": the daemon closed the connection");
    }
    if (received == client::Received::kNothing) continue;
    const message::ParsedLine parsed = message::parse_line(line);
    if (const auto* error = std::get_if<message::ParsedError>(&parsed)) {
      throw Failure("the daemon refused: " + error->text);
    }
    const auto* other = std::get_if<message::OtherLine>(&parsed);
    if (other != nullptr && other->name == "OK") return;
    take(line, parsed);
  }
}

void show_status(const RequestOptions& options) {
  const settings::Config config = options.settings.resolve_for_daemon();
  std::string pose;
  std::string status;
  std::optional<core::TimeNs> pose_ns;
  std::optional<core::TimeNs> status_ns;
  const bool is_text = options.format == "text";
  const auto keep = [&](std::string_view line, const message::ParsedLine& parsed) {
    const std::string shown = is_text ? message_text(parsed) : std::string(line) + "\n";
    if (const auto* one = std::get_if<message::ParsedPose>(&parsed)) {
      pose = shown;
      pose_ns = one->t_ns;
    }
    if (const auto* one = std::get_if<message::ParsedStatus>(&parsed)) {
      status = shown;
      status_ns = one->t_ns;
    }
  };
  ask(options.socket.empty() ? config.socket.pose : options.socket,
      "{\"class\":\"POLL\",\"classes\":[\"POSE\",\"STATUS\"],\"id\":1}\n", keep);
  // STATUS is of the last second.
  constexpr core::TimeNs kOld_ns = 2 * core::kNsPerSecond;
  if (is_text && pose_ns && status_ns && *status_ns - *pose_ns > kOld_ns) {
    pose = formatted("%.0f s old: ", core::to_seconds(*status_ns - *pose_ns)) + pose;
  }
  Output output;
  output.write(pose + status);
  output.flush();
}

void send_control(const RequestOptions& options, const std::string& request) {
  const settings::Config config = options.settings.resolve_for_daemon();
  ask(options.socket.empty() ? config.socket.control : options.socket, request,
      [](std::string_view, const message::ParsedLine&) {});
}

void set_pose(const RequestOptions& options) {
  const core::Pose2 T_map_base = parse_pose(options.pose);
  message::JsonText json(128);
  json.open_object();
  json.key("class");
  json.string("SET_POSE");
  json.key("x");
  json.shortest(T_map_base.x_m);
  json.key("y");
  json.shortest(T_map_base.y_m);
  json.key("theta");
  json.shortest(T_map_base.theta_rad);
  json.key("id");
  json.shortest(1);
  json.close_object();
  send_control(options, std::string(json.view()) + "\n");
}

std::shared_ptr<RequestOptions> add_shared(Command& command, const std::string& socket) {
  const auto options = std::make_shared<RequestOptions>();
  command
      .add_option("--socket", options->socket, "default: the " + socket + " socket of the config")
      .type_name("PATH");
  options->settings.add_config(command, kDaemonsConfig);
  return options;
}

}  // namespace

void add_status(Command& program) {
  Command command =
      program.add_subcommand("status", "the daemon's last pose and status, and what is wrong");
  const auto options = add_shared(command, "pose");
  command.add_option("--format", options->format, "json: as on the socket; text: for a person")
      .choices({"json", "text"})
      .capture_default_str();
  command.callback([options] { show_status(*options); });
}

void add_set_pose(Command& program) {
  Command command = program.add_subcommand("set-pose", "tell the daemon where the robot is");
  const auto options = add_shared(command, "control");
  command
      .add_option("--pose", options->pose,
                  "of the robot in the map (m, m, rad); --pose=X,Y,THETA where X is negative")
      .required()
      .type_name("X,Y,THETA");
  command.callback([options] { set_pose(*options); });
}

void add_relocalize(Command& program) {
  Command command =
      program.add_subcommand("relocalize", "let the daemon forget where the robot was");
  const auto options = add_shared(command, "control");
  command.callback([options] { send_control(*options, "{\"class\":\"RELOCALIZE\",\"id\":1}\n"); });
}

}  // namespace cornerd::tool
