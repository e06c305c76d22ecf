// SPDX-License-Identifier: MIT
#include "daemon/odometry_clients.hpp"

namespace cornerd::daemon {
namespace {

/// A second client is told of in so many STATUS after its last line.
constexpr int kTold = 5;

}  // namespace

bool OdometryClients::Giver::admits(int other, core::TimeNs now_ns) {
  if (connection >= 0 && connection != other && now_ns - last_ns <= kSilent_ns) return false;
  connection = other;
  last_ns = now_ns;
  return true;
}

bool OdometryClients::admit(int connection, core::TimeNs now_ns,
                            message::OdometryReading& reading) {
  const bool is_empty = !reading.left && !reading.right && !reading.gyro_rad_s;
  bool all = true;
  if ((reading.left || reading.right) && !counts_.admits(connection, now_ns)) {
    reading.left.reset();
    reading.right.reset();
    all = false;
  }
  if (reading.gyro_rad_s && !gyro_.admits(connection, now_ns)) {
    reading.gyro_rad_s.reset();
    all = false;
  }
  if (!all) ++refused_;
  if (is_empty || reading.left || reading.right || reading.gyro_rad_s) lines_.add(reading);
  return all;
}

void OdometryClients::forget(int connection) {
  if (counts_.connection == connection) counts_ = {};
  if (gyro_.connection == connection) gyro_ = {};
}

void OdometryClients::describe(message::StatusFields& status) {
  if (refused_ > told_) telling_ = kTold;
  told_ = refused_;
  status.second_client = refused_;
  const std::string_view why_absent = lines_.hint(*status.odometry, status.t_ns);
  const bool tells = telling_ > 0 && telling_-- > 0;
  status.odometry_hint =
      tells ? "two clients send ODOMETRY: the first one's is taken, the other's refused"
            : why_absent;
}

}  // namespace cornerd::daemon
