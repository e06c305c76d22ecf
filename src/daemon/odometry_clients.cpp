// SPDX-License-Identifier: MIT
#include "daemon/odometry_clients.hpp"

namespace cornerd::daemon {
namespace {

/// STATUS messages with the hint after the second client's last line.
constexpr int kHintRepeats = 5;
/// A restarted client may send a few lines before its old connection is closed.
constexpr std::uint64_t kMaxHandoverLines = 5;

}  // namespace

/// `is_useful`: the line is complete. `is_rejected`: the publisher's recent values were rejected.
bool OdometryClients::Publisher::accepts(int other, core::TimeNs now_ns, bool is_useful,
                                         bool is_rejected) {
  if (connection >= 0 && connection != other) {
    const bool is_silent = now_ns - last_ns > kSilenceTimeout_ns;
    const bool is_useless = is_useful && now_ns - useful_ns > kUselessTimeout_ns;
    if (!is_silent && !is_useless) return false;
  }
  if (connection != other || (is_useful && !is_rejected)) useful_ns = now_ns;
  connection = other;
  last_ns = now_ns;
  return true;
}

OdometryClients::Verdict OdometryClients::accept(int connection, core::TimeNs now_ns,
                                                 message::OdometryReading& reading) {
  const bool has_both_counts = reading.left && reading.right;
  const message::OdometryInputMonitor::Rejected rejected = input_.rejected();
  bool all = true;
  if ((reading.left || reading.right) &&
      !counts_.accepts(connection, now_ns, has_both_counts, rejected.counts)) {
    reading.left.reset();
    reading.right.reset();
    all = false;
  }
  if (reading.gyro_rad_s && !gyro_.accepts(connection, now_ns, /*is_useful=*/true, rejected.gyro)) {
    reading.gyro_rad_s.reset();
    all = false;
  }
  if (reading.left || reading.right || reading.gyro_rad_s) input_.add(reading);
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
  refusals_.clear();
  for (const auto& [cause, count] : input_.refusals()) {
    if (count > 0) refusals_.push_back({cause, count});
  }
  status.odometry_refusals = refusals_;
  status.odometry_hint = input_.hint(status.odometry->present);
  if (!expects_lines_ && !input_.are_refused()) status.odometry_hint = {};
  const bool is_shown = hint_repeats_ > 0 && hint_repeats_-- > 0;
  if (is_shown) {
    status.odometry_hint =
        "two clients send ODOMETRY: one client's lines are used, stop the other client";
  }
  status.odometry_fault = is_shown ? "odometry-second-client" : input_.fault();
}

}  // namespace cornerd::daemon
