// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "core/types.hpp"

namespace cornerd::drivers {

/// Estimates the measurement time of sample i. Model: t(i) = offset + period * i, arrival(i) = t(i)
/// + delay with delay >= 0 (USB frames, scheduling). The line is therefore an edge of the lower
/// convex hull of the last 4 s of arrivals: the one above the mean index (Moon, Skelly, Towsley
/// 1999).
///
/// Samples more than 50 ms late are either a backlog of the reader, whose delay shrinks as it is
/// read, or follow a pause of the device, whose delay stays. The clock is uncertain for 0.3 s until
/// that is decided. Bytes read while more were pending are a backlog.
class SampleClock {
 public:
  explicit SampleClock(double period_s) { reset(period_s); }

  /// Starts another stream.
  void reset(double period_s);
  /// The sample count is broken: keeps the period and forgets the offset.
  void reanchor();

  /// Sample `index` was measured at `latest_ns` or before. Indices never decrease. `more_pending`:
  /// the read left bytes behind.
  void observe(std::uint64_t index, core::TimeNs latest_ns, bool more_pending = false);

  /// True while time_of() may be wrong for the newest samples.
  bool is_uncertain() const { return uncertain_; }
  /// First sample of the current line, after a pause.
  std::uint64_t anchored_from() const { return anchored_from_; }

  /// Non-decreasing for growing indices.
  core::TimeNs time_of(std::uint64_t index);

  /// Delay of the newest observation, at least 0.
  core::TimeNs last_delay_ns() const { return last_delay_ns_; }

  bool anchored() const { return anchored_; }
  double period_s() const { return period_ns_ * 1e-9; }
  /// Times that a fit was discarded.
  std::uint64_t resets() const { return resets_; }

 private:
  /// x: samples, y: nanoseconds, both since the origin.
  struct Point {
    double x = 0;
    double y = 0;
  };

  double delay_ns(const Point& point) const {
    return point.y - (offset_ns_ + period_ns_ * point.x);
  }
  void set_period(double period_ns);
  void anchor(const Point& point);
  void check_delay(const Point& point, bool more_pending);
  void begin_uncertainty(const Point& point);
  void close_block();
  void remember(const Point& point);
  void fit();

  static constexpr std::size_t kBlocks = 32;  ///< 4 s

  double nominal_ns_ = 0;
  double period_ns_ = 0;
  core::TimeNs min_step_ns_ = 0;  ///< half of period_ns_: on ARMv7 a conversion is a library call
  double offset_ns_ = 0;
  std::uint64_t origin_index_ = 0;
  core::TimeNs origin_ns_ = 0;
  bool anchored_ = false;
  std::array<Point, kBlocks> points_{};  ///< the earliest arrival of each block, oldest first
  std::size_t point_count_ = 0;
  Point earliest_;  ///< of the block in progress
  double block_begin_ = 0;
  bool block_empty_ = true;
  bool uncertain_ = false;
  Point uncertain_from_;
  Point uncertain_earliest_;
  std::uint64_t anchored_from_ = 0;
  core::TimeNs last_ns_ = 0;
  bool has_last_ = false;
  std::uint64_t resets_ = 0;
  core::TimeNs last_delay_ns_ = 0;
};

}  // namespace cornerd::drivers
