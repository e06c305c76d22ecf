// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <set>
#include <vector>

#include "message/line_writer.hpp"
#include "message/odometry_input_monitor.hpp"
#include "message/request.hpp"

namespace cornerd::daemon {

/// Selects one publisher of encoder counts and one of gyro rates among the clients, because two
/// publishers of the same quantity would add a motion that did not happen. The first client stays
/// selected until it disconnects, is silent, or sends nothing usable for a while (only one wheel,
/// or lines that are all rejected). Counts and rates may come from different clients.
class OdometryClients {
 public:
  /// A publisher that pauses for longer loses its place.
  static constexpr core::TimeNs kSilenceTimeout_ns = core::kNsPerSecond;
  /// Longer than a clock step or a lidar fault makes good lines unusable.
  static constexpr core::TimeNs kUselessTimeout_ns = 4 * core::kNsPerSecond;

  enum class Verdict : std::uint8_t {
    kAccepted,
    kRejected,        ///< at least one value
    kFirstRejection,  ///< the first of this connection, which gets an ERROR
  };
  /// `expects_lines`: the config's odometry comes in lines; that none come is a fault.
  explicit OdometryClients(bool expects_lines) : expects_lines_(expects_lines) {}

  /// Removes values of which another client is the publisher; the caller uses the rest.
  /// `connection`: unique among open connections.
  Verdict accept(int connection, core::TimeNs now_ns, message::OdometryReading& reading);
  /// An ODOMETRY line that could not be read, or is not asked for.
  void refuse(const message::RequestError& error) { input_.refuse(error); }
  /// The connection was closed; its number may be reused.
  void disconnect(int connection);

  /// What became of the lines, by which a publisher keeps its place. Call it every second or more
  /// often.
  void update(const core::OdometryCounters& counters, core::TimeNs t_ns) {
    input_.update(counters, t_ns);
  }
  /// Sets second_client and odometry_hint. Call once for each STATUS, with odometry set.
  void describe(message::StatusFields& status);

 private:
  struct Publisher {
    int connection = -1;
    core::TimeNs last_ns = 0;
    core::TimeNs useful_ns = 0;  ///< its last complete, accepted line, or its selection

    bool accepts(int other, core::TimeNs now_ns, bool is_useful, bool is_rejected);
  };

  Publisher counts_;
  Publisher gyro_;
  std::set<int> rejected_connections_;  ///< of open connections
  message::OdometryInputMonitor input_;
  std::uint64_t rejected_ = 0;  ///< lines with a rejected value
  std::uint64_t reported_ = 0;  ///< rejected_ at the last STATUS
  bool expects_lines_;
  int hint_repeats_ = 0;                                  ///< STATUS messages left with the hint
  std::vector<message::StatusFields::Counter> refusals_;  ///< those of STATUS
};

}  // namespace cornerd::daemon
