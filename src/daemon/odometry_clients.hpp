// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <set>

#include "message/line_writer.hpp"
#include "message/odometry_input_monitor.hpp"
#include "message/request.hpp"

namespace cornerd::daemon {

/// Whose wheels and whose gyro are taken where several clients send them. Two that send the same,
/// a moment apart, make a motion of their own: the first one goes on, the other is rejected until
/// the first has gone or fallen silent, or nothing that it gives has been of use for a while: the
/// count of one wheel alone, lines that are all rejected. Counts and rates may come from different
/// clients.
class OdometryClients {
 public:
  /// Longer than any pause of a client that is worth its odometry.
  static constexpr core::TimeNs kSilenceTimeout_ns = core::kNsPerSecond;
  /// Longer than the robot's clock or the lidar may trouble the lines of a good one.
  static constexpr core::TimeNs kUselessTimeout_ns = 4 * core::kNsPerSecond;

  enum class Verdict : std::uint8_t {
    kAccepted,
    kRejected,        ///< all of it, or a part
    kFirstRejection,  ///< the first time of this connection: it should be told
  };
  /// Takes out of the reading what another client gives; the rest, if there is any, is to be taken.
  /// `connection`: any number that no other open one has.
  Verdict accept(int connection, core::TimeNs now_ns, message::OdometryReading& reading);
  /// The connection has ended; its number may be another's now.
  void disconnect(int connection);

  /// How many lines were rejected, and what is wrong with those that come: for a STATUS whose
  /// odometry and time are set. To be called for each.
  void describe(message::StatusFields& status);

 private:
  struct Publisher {
    int connection = -1;
    core::TimeNs last_ns = 0;
    core::TimeNs useful_ns = 0;  ///< when it last gave what is of use, or took the place

    bool accepts(int other, core::TimeNs now_ns, bool is_useful, bool is_refused);
  };

  Publisher counts_;
  Publisher gyro_;
  std::set<int> rejected_connections_;  ///< open ones
  message::OdometryInputMonitor lines_;
  std::uint64_t rejected_ = 0;  ///< lines of which anything was
  std::uint64_t reported_ = 0;  ///< of them
  int hint_repeats_ = 0;        ///< in so many STATUS more
};

}  // namespace cornerd::daemon
