// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>

#include "core/odometry/jitter_estimator.hpp"
#include "core/odometry/odometry_config.hpp"
#include "core/odometry/odometry_increment.hpp"
#include "core/odometry/odometry_reading.hpp"
#include "core/odometry/odometry_summary.hpp"

namespace cornerd::core {

/// Validates readings and makes odometry increments of them. A bad reading is dropped alone. Counts
/// or times that stay elsewhere mean a restarted controller: a new start after an increment that is
/// a gap, which ends before it begins where the clock was set back. Counts and rates may come in
/// separate readings. Allocates nothing.
class ReadingGate {
 public:
  explicit ReadingGate(const OdometryConfig& config) : config_(config) {}

  /// The increment that ends with this reading, if one does. Without an arrival time nothing is of
  /// the future.
  std::optional<OdometryIncrement> add(const OdometryReading& reading);

  const OdometryCounters& counters() const { return counters_; }

 private:
  struct Counts {
    TimeNs t_ns = 0;
    std::int64_t left = 0;
    std::int64_t right = 0;
  };

  bool is_in_time(TimeNs t_ns, std::optional<TimeNs> arrival_ns);
  bool is_always_ahead(TimeNs t_ns, TimeNs arrival_ns);
  bool clock_leapt(TimeNs t_ns, TimeNs arrival_ns) const;
  /// `arrival_ns`: where the clocks are to be compared.
  bool leaps_ahead(TimeNs t_ns, std::optional<TimeNs> arrival_ns);
  void add_gyro(TimeNs t_ns, double rate_rad_s);
  std::optional<OdometryIncrement> add_counts(const Counts& counts);
  std::optional<OdometryIncrement> restart(const Counts& counts);
  bool is_possible(const Counts& from, const Counts& to) const;
  /// No wheel changes its speed as much between two readings.
  bool is_sudden(const Counts& before, const Counts& from, const Counts& to) const;
  OdometryIncrement step_between(const Counts& from, const Counts& to);
  /// Moves what the gyro said since the last counts into the step.
  void take_gyro(OdometryIncrement& step);
  bool gyro_is_stuck(const OdometryIncrement& step);

  OdometryConfig config_;
  OdometryCounters counters_;
  std::optional<TimeNs> last_ns_;  ///< of any reading that was taken
  std::optional<TimeNs> last_arrival_ns_;
  std::optional<TimeNs> refused_ns_;  ///< the newest reading that was before the last one
  std::uint32_t refused_in_a_row_ = 0;
  // Of the last second or two.
  std::optional<TimeNs> compared_since_ns_;
  TimeNs least_ahead_ns_ = 0;
  TimeNs least_ahead_before_ns_ = 0;
  std::optional<double> period_s_;   ///< between two readings
  std::optional<TimeNs> leapt_ns_;   ///< the newest reading that was ahead
  std::uint32_t leaps_ = 0;          ///< how many in a row agree with each other
  bool clock_was_set_back_ = false;  ///< and no counts have come since

  JitterEstimator jitter_;
  std::optional<Counts> last_;
  std::optional<Counts> before_last_;  ///< where the robot came on from there to it
  std::optional<Counts> doubted_;      ///< the newest counts that jumped
  std::uint32_t doubts_ = 0;           ///< how many in a row agree with each other

  // The gyro since the last counts.
  std::optional<TimeNs> gyro_ns_;
  double gyro_rad_s_ = 0;
  double gyro_rad_ = 0;
  double gyro_change_rad_ = 0;
  double gyro_covered_s_ = 0;

  // How long the gyro has said the same.
  std::uint32_t same_rates_ = 0;
  double turned_since_rad_ = 0;  ///< by the wheels, less the gyro
  bool gyro_is_stuck_ = false;   ///< until it says something else
};

}  // namespace cornerd::core
