// SPDX-License-Identifier: MIT
#include "tool/doctor/daemon_probe.hpp"

#include <poll.h>

#include <numeric>
#include <string_view>

#include "tool/doctor/machine.hpp"
#include "tool/socket_client.hpp"

namespace cornerd::tool {

namespace {

/// At an A1's pace a second and a half.
constexpr std::uint64_t kEnoughPoses = 10;

void note_line(std::string_view line, DaemonView& view) {
  message::ToldLine told = message::parse_told_line(line);
  if (const auto* version = std::get_if<message::ToldVersion>(&told)) {
    view.version = version->version;
  } else if (auto* status = std::get_if<message::ToldStatus>(&told)) {
    view.status = std::move(*status);
  } else if (const auto* pose = std::get_if<message::ToldPose>(&told)) {
    ++view.poses[static_cast<std::size_t>(pose->state)];
  }
}

bool has_heard_enough(const DaemonView& view) {
  return view.status &&
         std::accumulate(view.poses.begin(), view.poses.end(), std::uint64_t{0}) >= kEnoughPoses;
}

}  // namespace

DaemonView probe_daemon(const std::filesystem::path& socket, std::chrono::milliseconds at_most) {
  using Clock = std::chrono::steady_clock;
  DaemonView view;
  SocketClient daemon;
  if (!daemon.connect(socket, /*patient=*/false)) {
    view.connect_errno = daemon.error_number();
    return view;
  }
  const Clock::time_point end = Clock::now() + at_most;
  while (!has_heard_enough(view)) {
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(end - Clock::now());
    if (left.count() <= 0) break;
    pollfd entry{.fd = daemon.fd(), .events = POLLIN, .revents = 0};
    if (::poll(&entry, 1, static_cast<int>(left.count())) <= 0) continue;
    const auto lines = daemon.take();
    if (!lines) break;
    for (const std::string_view line : split_words(*lines, "\n")) note_line(line, view);
  }
  return view;
}

}  // namespace cornerd::tool
