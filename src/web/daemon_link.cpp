// SPDX-License-Identifier: MIT
#include "web/daemon_link.hpp"

namespace cornerd::web {

namespace {

/// The page follows a restarted daemon at once.
constexpr std::chrono::milliseconds kLargestRetryDelay{500};
/// How long a stop may take.
constexpr std::chrono::milliseconds kStopTime{250};

}  // namespace

void follow_daemon(const std::filesystem::path& pose_socket, const std::stop_token& stop,
                   const std::function<void(client::Event, std::string_view)>& tell) {
  client::Subscription daemon(pose_socket,
                              client::watch_request("POSE,SCAN,BREAKPOINTS,STATUS,EVENT,MAP"),
                              kLargestRetryDelay);
  std::string_view line;
  while (!stop.stop_requested()) {
    const client::Event event = daemon.wait(line, kStopTime);
    if (event == client::Event::kTimeout) continue;
    tell(event, event == client::Event::kMessage ? line : std::string_view(daemon.problem()));
  }
}

}  // namespace cornerd::web
