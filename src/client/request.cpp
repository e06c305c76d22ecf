// SPDX-License-Identifier: MIT
#include "client/request.hpp"

#include "client/connection.hpp"

namespace cornerd::client {

Answer ask(const std::filesystem::path& socket, std::string_view line,
           std::chrono::milliseconds timeout) {
  using Kind = Answer::Kind;
  using Clock = std::chrono::steady_clock;
  const Clock::time_point until = Clock::now() + timeout;
  Connection daemon;
  if (!daemon.connect(socket, /*blocking=*/false) || !daemon.send(line)) {
    return {Kind::kNone, daemon.problem() + " (does cornerd run, and is this user in its group?)"};
  }
  for (std::string_view answer;;) {
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(until - Clock::now());
    if (left.count() <= 0 || daemon.receive(answer, left) != Received::kLine) {
      return {Kind::kNone, "the daemon did not answer"};
    }
    if (answer.starts_with(R"({"class":"OK")")) return {Kind::kOk, std::string(answer)};
    if (answer.starts_with(R"({"class":"ERROR")")) return {Kind::kError, std::string(answer)};
  }
}

}  // namespace cornerd::client
