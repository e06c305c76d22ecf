// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "core/odometry/odometry_reading.hpp"
#include "core/odometry/odometry_summary.hpp"
#include "message/field_reader.hpp"
#include "message/request.hpp"

namespace cornerd::message {

/// Counts what ODOMETRY lines contain, and reports why odometry is absent.
class OdometryInputMonitor {
 public:
  void add(const core::OdometryReading& reading);
  /// A line that could not be read.
  void refuse(const RequestError& error);

  /// Lines that could not be read, since the start, by FieldReader's cause or "json".
  struct Refusals {
    std::string_view cause;
    std::uint64_t count = 0;
  };
  std::span<const Refusals> refusals() const { return refusals_; }

  /// Evaluates the lines of each interval of 0.9 s, however often it is called. `counters`: of the
  /// readings among them.
  void update(const core::OdometryCounters& counters, core::TimeNs t_ns);

  /// Why odometry is absent, from the last interval; empty if it is `present` or the lines have
  /// just begun. Also says that most lines are refused.
  std::string_view hint(bool present) const {
    return present && !are_refused_ ? std::string_view() : hint_;
  }

  /// True if most values of the last evaluated interval were rejected, for any reason.
  struct Rejected {
    bool counts = false;
    bool gyro = false;
  };
  Rejected rejected() const { return rejected_; }
  /// Most lines of the last evaluated interval could not be read.
  bool are_refused() const { return are_refused_; }
  /// Which fault of STATUS hint() is about.
  std::string_view fault() const { return are_refused_ ? "odometry-refused" : "odometry-absent"; }

 private:
  struct LineCounts {
    std::uint64_t all = 0;       ///< that could be read
    std::uint64_t repeated = 0;  ///< with the t of the line before
    std::uint64_t refused = 0;   ///< that could not
    std::uint64_t both = 0;      ///< with left and right
    std::uint64_t left = 0;      ///< with left only
    std::uint64_t right = 0;     ///< with right only
    std::uint64_t rates = 0;     ///< with a gyro
  };
  std::string diagnose(const core::OdometryCounters& counters, core::TimeNs t_ns) const;
  Rejected find_rejected(const core::OdometryCounters& counters) const;

  LineCounts lines_;                 ///< since the last evaluation
  core::OdometryCounters counters_;  ///< at the last evaluation
  std::optional<core::TimeNs> evaluated_ns_;
  core::TimeNs newest_ns_ = 0;  ///< time of the last reading
  struct Interval {
    std::uint64_t count = 0;
    core::TimeNs t_ns = 0;  ///< its end
  };
  std::optional<Interval> last_lines_;  ///< the last interval with a line
  std::array<Refusals, 6> refusals_{{{"json"},
                                     {FieldReader::kMissing},
                                     {FieldReader::kNotANumber},
                                     {FieldReader::kNotWhole},
                                     {FieldReader::kOutOfRange},
                                     {FieldReader::kOther}}};
  std::string refusal_;       ///< text of the last one
  bool are_refused_ = false;  ///< most lines of the last interval
  std::string hint_;
  Rejected rejected_;
};

}  // namespace cornerd::message
