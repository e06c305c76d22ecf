// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "core/odometry/odometry_reading.hpp"
#include "core/odometry/odometry_summary.hpp"

namespace cornerd::message {

/// Watches what ODOMETRY lines bear, to say why there is no odometry though its source is there.
/// Allocates nothing.
class OdometryLines {
 public:
  void add(const core::OdometryReading& reading);

  /// Why the summary's odometry is absent, of the lines of about the last second; empty where it is
  /// not, or nothing is known. `t_ns`: now, by the clock of earlier calls.
  std::string_view hint(const core::OdometrySummary& summary, core::TimeNs t_ns);

  /// What was refused of most of the lines that the last hint() judged, whatever the cause.
  struct Refused {
    bool counts = false;
    bool gyro = false;
  };
  Refused refused() const { return refused_; }

 private:
  struct Seen {
    std::uint64_t lines = 0;
    std::uint64_t whole = 0;  ///< with left and right
    std::uint64_t left = 0;   ///< alone
    std::uint64_t right = 0;  ///< alone
    std::uint64_t gyro = 0;   ///< with neither of them
    std::uint64_t rates = 0;  ///< with a gyro, with wheels or without
  };
  std::string_view judge(const core::OdometryCounters& counters) const;
  Refused judge_refusals(const core::OdometryCounters& counters) const;

  Seen seen_;                        ///< since the last judgement
  core::OdometryCounters counters_;  ///< at the last judgement
  std::optional<core::TimeNs> judged_ns_;
  std::string_view hint_;
  Refused refused_;
};

}  // namespace cornerd::message
