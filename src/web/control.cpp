// SPDX-License-Identifier: MIT
#include "web/control.hpp"

#include <algorithm>
#include <chrono>
#include <string_view>

#include "client/connection.hpp"
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
  client::Connection daemon;
  if (!daemon.connect(control_socket, /*blocking=*/false) || !daemon.send(line)) {
    return error_response(503, "unavailable",
                          daemon.problem() + " (does cornerd run, and is this user in its group?)");
  }
  const auto until = std::chrono::steady_clock::now() + kAnswerTime;
  for (std::string_view answer;;) {
    const auto left =
        std::chrono::ceil<std::chrono::milliseconds>(until - std::chrono::steady_clock::now());
    if (left.count() <= 0 || daemon.receive(answer, left) != client::Received::kLine) {
      return error_response(503, "unavailable", "the daemon did not answer");
    }
    const bool done = answer.starts_with(R"({"class":"OK")");
    if (done || answer.starts_with(R"({"class":"ERROR")")) {
      return {.status = done ? 200u : 409u, .body = std::string(answer) + "\n"};
    }
  }
}

}  // namespace cornerd::web
