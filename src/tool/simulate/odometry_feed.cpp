// SPDX-License-Identifier: MIT
#include "tool/simulate/odometry_feed.hpp"

#include <cstdio>
#include <string_view>

namespace cornerd::tool {

void OdometryFeed::send_until(core::TimeNs t_ns, core::TimeNs unix_ns) {
  const bool connected = is_connected(t_ns);
  while (odometry_.next_ns() <= t_ns) {
    core::OdometryReading reading = odometry_.next();
    if (!connected || !daemon_.is_connected()) continue;
    reading.t_ns += unix_ns - t_ns;
    if (!daemon_.send(line_.odometry(reading))) daemon_.close();
  }
  print_answers();
}

bool OdometryFeed::is_connected(core::TimeNs t_ns) {
  if (daemon_.is_connected()) return true;
  if (t_ns < next_try_ns_) return false;
  next_try_ns_ = t_ns + core::kNsPerSecond;
  if (daemon_.connect(control_, /*blocking=*/false)) return true;
  if (!has_complained_) {
    std::fprintf(stderr, "cornerctl: %s; waiting for the daemon\n", daemon_.problem().c_str());
  }
  has_complained_ = true;
  return false;
}

/// Accepted readings get no answer.
void OdometryFeed::print_answers() {
  std::string_view line;
  client::Received received =
      daemon_.is_connected() ? daemon_.take(line) : client::Received::kNothing;
  for (; received == client::Received::kLine; received = daemon_.take(line)) {
    if (line.find("\"ERROR\"") != std::string_view::npos && !has_complained_) {
      std::fprintf(stderr, "cornerctl: the daemon: %.*s\n", static_cast<int>(line.size()),
                   line.data());
      has_complained_ = true;
    }
  }
  if (received == client::Received::kEnd) daemon_.close();
}

}  // namespace cornerd::tool
