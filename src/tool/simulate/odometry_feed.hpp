// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

#include "client/connection.hpp"
#include "message/line_writer.hpp"
#include "replay/simulator/simulated_odometry.hpp"

namespace cornerd::tool {

/// Sends a simulated robot's readings to the daemon's control socket, as a robot's program does.
class OdometryFeed {
 public:
  OdometryFeed(std::filesystem::path control, replay::SimulatedOdometry odometry)
      : control_(std::move(control)), odometry_(std::move(odometry)) {}

  /// Sends what was measured until `t_ns`, which is `unix_ns`. Connects again once a second where
  /// the daemon is not there.
  void send_until(core::TimeNs t_ns, core::TimeNs unix_ns);

 private:
  bool is_connected(core::TimeNs t_ns);
  void print_answers();

  std::filesystem::path control_;
  replay::SimulatedOdometry odometry_;
  client::Connection daemon_;
  core::TimeNs next_try_ns_ = 0;
  bool has_complained_ = false;
  message::LineWriter line_;
};

}  // namespace cornerd::tool
