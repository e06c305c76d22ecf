// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "core/types.hpp"

namespace cornerd::rplidar {

/// When was sample number i measured? The device counts at an even pace, which is not quite the
/// nominal one; the arrivals of its bytes are that pace plus delays (USB frames, scheduling, a
/// reader that was held up). A delay is never negative, so the line under all arrivals is the
/// device's clock: the edge of their lower convex hull that spans the middle of the last seconds.
///
/// Samples that come far later than they should are a backlog, which is seen sooner than a device
/// measures it, or they were measured later, after a pause or after others that nobody counted. A
/// third of a second of them tells which; until then the clock is in doubt. What a read leaves
/// behind is a backlog, however slowly it is read.
class SampleClock {
 public:
  explicit SampleClock(double period_s) { reset(period_s); }

  /// Another stream: forgets everything.
  void reset(double period_s);
  /// The count of the samples has been broken: its pace still holds, its offset does not.
  void reanchor();

  /// Sample `index` was measured at `latest_ns` or before. Indices never decrease. `more_waits`: it
  /// was read while others were waiting.
  void observe(std::uint64_t index, core::TimeNs latest_ns, bool more_waits = false);

  /// True while nobody knows whether time_of() holds for the newest samples.
  bool in_doubt() const { return in_doubt_; }
  /// Where a doubt ended in another anchor: the first sample that it is good for.
  std::uint64_t anchored_from() const { return anchored_from_; }

  /// Time of a sample. Called with growing indices it never goes back.
  core::TimeNs time_of(std::uint64_t index);

  /// How much later than could be the newest observation was made.
  core::TimeNs last_lateness_ns() const { return last_lateness_ns_; }

  bool anchored() const { return anchored_; }
  double period_s() const { return period_ns_ * 1e-9; }
  /// Times that the fit had to be given up after it had begun.
  std::uint64_t resets() const { return resets_; }

 private:
  /// x: samples, y: nanoseconds, both since the origin.
  struct Point {
    double x = 0;
    double y = 0;
  };

  double lateness_ns(const Point& point) const {
    return point.y - (offset_ns_ + period_ns_ * point.x);
  }
  void anchor(const Point& point);
  void doubt(const Point& point, bool more_waits);
  void begin_doubt(const Point& point);
  void close_block();
  void remember(const Point& point);
  void fit();

  static constexpr std::size_t kBlocks = 32;  ///< 4 s

  double nominal_ns_ = 0;
  double period_ns_ = 0;
  double offset_ns_ = 0;
  std::uint64_t origin_index_ = 0;
  core::TimeNs origin_ns_ = 0;
  bool anchored_ = false;
  std::array<Point, kBlocks> points_{};  ///< the earliest arrival of each block, oldest first
  std::size_t point_count_ = 0;
  Point earliest_;  ///< of the block in progress
  double block_begin_ = 0;
  bool block_empty_ = true;
  bool in_doubt_ = false;
  Point doubt_begin_;
  Point doubt_earliest_;
  std::uint64_t anchored_from_ = 0;
  core::TimeNs last_ns_ = 0;
  bool has_last_ = false;
  std::uint64_t resets_ = 0;
  core::TimeNs last_lateness_ns_ = 0;
};

}  // namespace cornerd::rplidar
