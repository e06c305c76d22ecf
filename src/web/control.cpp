// SPDX-License-Identifier: MIT
#include "web/control.hpp"

#include <algorithm>
#include <chrono>

#include "client/request.hpp"
#include "message/request.hpp"

namespace cornerd::web {

namespace {

/// SET_MAP is answered when the map is loaded.
constexpr std::chrono::seconds kAnswerTime{20};

}  // namespace

Response ask_daemon(const std::filesystem::path& control_socket, const std::string& body) {
  std::string line = body;
  // Between JSON's tokens a newline is a space; in a string it is an error, which the daemon names.
  std::replace(line.begin(), line.end(), '\n', ' ');
  std::replace(line.begin(), line.end(), '\r', ' ');
  const message::Request request = message::parse_request(line);
  if (const auto* error = std::get_if<message::RequestError>(&request.body)) {
    return error_response(409, error->code, error->text);
  }
  if (std::holds_alternative<message::WatchRequest>(request.body) ||
      std::holds_alternative<message::OdometryReading>(request.body)) {
    return error_response(400, "class",
                          request.name + " is for sockets; for messages use /api/events");
  }
  line += '\n';
  const client::Answer answer = client::ask(control_socket, line, kAnswerTime);
  if (answer.kind == client::Answer::Kind::kNone) {
    return error_response(503, "unavailable", answer.text);
  }
  const bool done = answer.kind == client::Answer::Kind::kOk;
  return {.status = done ? 200u : 409u, .body = answer.text + "\n"};
}

}  // namespace cornerd::web
