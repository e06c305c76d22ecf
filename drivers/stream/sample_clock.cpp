// SPDX-License-Identifier: MIT
#include "drivers/stream/sample_clock.hpp"

#include <algorithm>
#include <numeric>

namespace cornerd::drivers {
namespace {

constexpr double kBlockNs = 125e6;
constexpr std::size_t kMinBlocks = 3;

// The delay of a backlog shrinks by the time its samples took, or by most of it if the reader is
// slow; the delay after a pause stays.
constexpr double kMaxDelayNs = 50e6;
constexpr double kDecisionNs = 300e6;
constexpr double kMinCatchUpRate = 0.3;

// Period relative to the nominal one, which may be another mode's (201 us for 127).
constexpr double kMinPace = 0.5;
constexpr double kMaxPace = 2.0;

}  // namespace

void SampleClock::reset(double period_s) {
  reanchor();
  nominal_ns_ = period_s * 1e9;
  set_period(nominal_ns_);
}

void SampleClock::set_period(double period_ns) {
  period_ns_ = period_ns;
  min_step_ns_ = static_cast<core::TimeNs>(period_ns / 2);
}

void SampleClock::reanchor() {
  if (anchored_) ++resets_;
  anchored_ = false;
  uncertain_ = false;
}

void SampleClock::observe(std::uint64_t index, core::TimeNs latest_ns, bool more_pending) {
  if (!anchored_) {
    origin_index_ = index;
    origin_ns_ = latest_ns;
    anchored_from_ = index;
    anchor({0, 0});
  }
  const Point point{static_cast<double>(index - origin_index_),
                    static_cast<double>(latest_ns - origin_ns_)};
  offset_ns_ += std::min(0.0, delay_ns(point));
  check_delay(point, more_pending);
  last_delay_ns_ = static_cast<core::TimeNs>(std::max(0.0, delay_ns(point)));
  if (uncertain_) return;

  if (block_empty_ || delay_ns(point) < delay_ns(earliest_)) earliest_ = point;
  block_empty_ = false;
  if ((point.x - block_begin_) * nominal_ns_ >= kBlockNs) {
    close_block();
    block_begin_ = point.x;
    block_empty_ = true;
  }
}

void SampleClock::check_delay(const Point& point, bool more_pending) {
  if (delay_ns(point) <= kMaxDelayNs) {
    uncertain_ = false;
    return;
  }
  if (!uncertain_ || more_pending) return begin_uncertainty(point);
  if (delay_ns(point) < delay_ns(uncertain_earliest_)) uncertain_earliest_ = point;
  const double lasted_ns = (point.x - uncertain_from_.x) * nominal_ns_;
  if (lasted_ns < kDecisionNs) return;
  if (delay_ns(point) < delay_ns(uncertain_from_) - kMinCatchUpRate * lasted_ns) {
    return begin_uncertainty(point);
  }
  ++resets_;
  anchored_from_ = origin_index_ + static_cast<std::uint64_t>(uncertain_from_.x);
  anchor(uncertain_earliest_);
}

void SampleClock::begin_uncertainty(const Point& point) {
  uncertain_ = true;
  uncertain_from_ = uncertain_earliest_ = point;
}

core::TimeNs SampleClock::time_of(std::uint64_t index) {
  const double x = static_cast<double>(static_cast<std::int64_t>(index - origin_index_));
  core::TimeNs t_ns = origin_ns_ + static_cast<core::TimeNs>(offset_ns_ + period_ns_ * x);
  // If the fit moved back, times advance at half a period until it catches up.
  if (has_last_) t_ns = std::max(t_ns, last_ns_ + min_step_ns_);
  last_ns_ = t_ns;
  has_last_ = true;
  return t_ns;
}

void SampleClock::anchor(const Point& point) {
  offset_ns_ = point.y - period_ns_ * point.x;
  anchored_ = true;
  point_count_ = 0;
  block_begin_ = point.x;
  block_empty_ = true;
  uncertain_ = false;
}

void SampleClock::close_block() {
  remember(earliest_);
  if (point_count_ >= kMinBlocks) fit();
}

void SampleClock::remember(const Point& point) {
  if (point_count_ == kBlocks) {
    std::copy(points_.begin() + 1, points_.end(), points_.begin());
    --point_count_;
  }
  points_[point_count_++] = point;
}

// The line below all points with the least sum of distances is the lower hull's edge above the mean
// of x (Moon, Skelly, Towsley 1999, Estimation and removal of clock skew from network delay
// measurements).
void SampleClock::fit() {
  std::array<Point, kBlocks> hull;
  std::size_t size = 0;
  double sum_x = 0;
  for (std::size_t i = 0; i < point_count_; ++i) {
    const Point& point = points_[i];
    sum_x += point.x;
    const auto above_edge = [&] {
      const Point& a = hull[size - 2];
      const Point& b = hull[size - 1];
      return (b.y - a.y) * (point.x - a.x) >= (point.y - a.y) * (b.x - a.x);
    };
    while (size >= 2 && above_edge()) --size;
    hull[size++] = point;
  }
  const double mean_x = sum_x / static_cast<double>(point_count_);
  std::size_t end = 1;
  while (end + 1 < size && hull[end].x < mean_x) ++end;
  const Point& a = hull[end - 1];
  const Point& b = hull[end];
  if (b.x <= a.x) return;
  const double pace_ns = (b.y - a.y) / (b.x - a.x);
  if (pace_ns < kMinPace * nominal_ns_ || pace_ns > kMaxPace * nominal_ns_) return;
  set_period(pace_ns);
  offset_ns_ = a.y - pace_ns * a.x;
}

}  // namespace cornerd::drivers
