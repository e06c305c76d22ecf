// SPDX-License-Identifier: MIT
#include "daemon/odometry_clients.hpp"

namespace cornerd::daemon {
namespace {

/// A second client is told of in so many STATUS after its last line.
constexpr int kHintRepeats = 5;
/// A controller that is started again may be heard before its old connection is seen to have ended.
constexpr std::uint64_t kMaxHandoverLines = 5;

}  // namespace

/// `is_useful`: what comes is all that is needed. `is_refused`: what this gives is, of late.
bool OdometryClients::Publisher::accepts(int other, core::TimeNs now_ns, bool is_useful,
                                         bool is_refused) {
  if (connection >= 0 && connection != other) {
    const bool is_silent = now_ns - last_ns > kSilenceTimeout_ns;
    const bool is_useless = is_useful && now_ns - useful_ns > kUselessTimeout_ns;
    if (!is_silent && !is_useless) return false;
  }
  if (connection != other || (is_useful && !is_refused)) useful_ns = now_ns;
  connection = other;
  last_ns = now_ns;
  return true;
}

OdometryClients::Verdict OdometryClients::accept(int connection, core::TimeNs now_ns,
                                                 message::OdometryReading& reading) {
  const bool is_empty = !reading.left && !reading.right && !reading.gyro_rad_s;
  const bool is_whole = reading.left && reading.right;
  const message::OdometryInputMonitor::Refused rejected = lines_.rejected();
  bool all = true;
  if ((reading.left || reading.right) &&
      !counts_.accepts(connection, now_ns, is_whole, rejected.counts)) {
    reading.left.reset();
    reading.right.reset();
    all = false;
  }
  if (reading.gyro_rad_s && !gyro_.accepts(connection, now_ns, /*is_useful=*/true, rejected.gyro)) {
    reading.gyro_rad_s.reset();
    all = false;
  }
  if (is_empty || reading.left || reading.right || reading.gyro_rad_s) lines_.add(reading);
  if (all) return Verdict::kAccepted;
  ++rejected_;
  return rejected_connections_.insert(connection).second ? Verdict::kFirstRejection
                                                         : Verdict::kRejected;
}

void OdometryClients::disconnect(int connection) {
  if (counts_.connection == connection) counts_ = {};
  if (gyro_.connection == connection) gyro_ = {};
  rejected_connections_.erase(connection);
}

void OdometryClients::describe(message::StatusFields& status) {
  if (rejected_ - reported_ > kMaxHandoverLines) hint_repeats_ = kHintRepeats;
  reported_ = rejected_;
  status.second_client = rejected_;
  const std::string_view why_absent = lines_.hint(*status.odometry, status.t_ns);
  const bool tells = hint_repeats_ > 0 && hint_repeats_-- > 0;
  status.odometry_hint =
      tells ? "two clients send ODOMETRY: one's is taken, the other's refused" : why_absent;
}

}  // namespace cornerd::daemon
