// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "core/odometry/odometry_reading.hpp"
#include "core/odometry/odometry_summary.hpp"

namespace cornerd::message {

/// Counts what ODOMETRY lines contain, and reports why odometry is absent. Allocates nothing.
class OdometryInputMonitor {
 public:
  void add(const core::OdometryReading& reading);

  /// Why odometry is absent, from the lines of about the last second; empty if it is present or the
  /// cause is unknown. `t_ns`: the current time.
  std::string_view hint(const core::OdometrySummary& summary, core::TimeNs t_ns);

  /// True if most values of the last evaluated interval were rejected, for any reason.
  struct Rejected {
    bool counts = false;
    bool gyro = false;
  };
  Rejected rejected() const { return rejected_; }

 private:
  struct LineCounts {
    std::uint64_t all = 0;
    std::uint64_t both = 0;   ///< with left and right
    std::uint64_t left = 0;   ///< with left only
    std::uint64_t right = 0;  ///< with right only
    std::uint64_t gyro = 0;   ///< with a gyro and no counts
    std::uint64_t rates = 0;  ///< with a gyro
  };
  std::string_view diagnose(const core::OdometryCounters& counters) const;
  Rejected find_rejected(const core::OdometryCounters& counters) const;

  LineCounts lines_;                 ///< since the last evaluation
  core::OdometryCounters counters_;  ///< at the last evaluation
  std::optional<core::TimeNs> evaluated_ns_;
  std::string_view hint_;
  Rejected rejected_;
};

}  // namespace cornerd::message
