// SPDX-License-Identifier: MIT
#include "core/breakpoint/breakpoint_stream.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/breakpoint/detector.hpp"

namespace cornerd::core {

BreakpointStream::BreakpointStream(const DetectorConfig& config, const SensorNoise& noise)
    : tracker_(config, noise), chain_(config, noise) {
  mirrored_.reserve(kMaxBreakpointsPerScan);
}

void BreakpointStream::begin(double spacing_rad, Sweep sweep) {
  sweep_ = sweep;
  tracker_.begin();
  chain_.begin();
  scan_.begin(spacing_rad);
  detection_.clear();
  waiting_count_ = 0;
  begun_ = false;
  finished_ = false;
}

std::span<const Breakpoint> BreakpointStream::add(double bearing_rad, double range_m) {
  const std::size_t known = detection_.breakpoints.size();
  if (finished_ || !(range_m > 0) || !std::isfinite(range_m) || !std::isfinite(bearing_rad)) {
    return news(known);
  }
  const double angle_rad = static_cast<int>(sweep_) * bearing_rad;
  if (!begun_) {
    begun_ = true;
    begin_rad_ = reached_rad_ = angle_rad;
  }
  // The sweep goes on from where it was: bearings wrap, it does not.
  const Return item{reached_rad_ + angle_between(reached_rad_, angle_rad), range_m};
  reached_rad_ = std::max(reached_rad_, item.sweep_rad);
  if (item.sweep_rad >= begin_rad_ + kTwoPi || item.sweep_rad < begin_rad_ - kMaxStepBack_rad) {
    return news(known);
  }

  if (waiting_count_ == waiting_.size()) {
    take(waiting_[0]);
    std::move(waiting_.begin() + 1, waiting_.begin() + waiting_count_, waiting_.begin());
    --waiting_count_;
  }
  std::size_t place = waiting_count_++;
  for (; place > 0 && waiting_[place - 1].sweep_rad > item.sweep_rad; --place) {
    waiting_[place] = waiting_[place - 1];
  }
  waiting_[place] = item;

  std::size_t taken = 0;
  while (taken < waiting_count_ && waiting_[taken].sweep_rad < reached_rad_ - kMaxStepBack_rad) {
    take(waiting_[taken++]);
  }
  std::move(waiting_.begin() + taken, waiting_.begin() + waiting_count_, waiting_.begin());
  waiting_count_ -= taken;
  if (taken > 0) feed(tracker_, chain_, scan_, /*ended=*/false, detection_);
  return news(known);
}

void BreakpointStream::take(const Return& item) {
  // One that comes later than it may is lost: what was tracked stays as it is.
  if (scan_.size() > 0 && item.sweep_rad < scan_[scan_.size() - 1].bearing_rad) return;
  scan_.append(item.sweep_rad, item.range_m);
}

std::span<const Breakpoint> BreakpointStream::finish() {
  const std::size_t known = detection_.breakpoints.size();
  if (finished_) return news(known);
  finished_ = true;
  for (std::size_t i = 0; i < waiting_count_; ++i) take(waiting_[i]);
  waiting_count_ = 0;
  feed(tracker_, chain_, scan_, /*ended=*/true, detection_);
  detection_.noise_scale = tracker_.noise_scale();
  chain_.finish(scan_, detection_.noise_scale, detection_);
  return news(known);
}

std::span<const Breakpoint> BreakpointStream::news(std::size_t known) {
  const std::span<const Breakpoint> found = std::span(detection_.breakpoints).subspan(known);
  if (sweep_ == Sweep::kCounterClockwise) return found;
  mirrored_.clear();
  for (const Breakpoint& breakpoint : found) mirrored_.push_back(mirrored(breakpoint));
  return mirrored_;
}

Breakpoint mirrored(const Breakpoint& breakpoint) {
  Breakpoint image = breakpoint;
  image.position.y() = -image.position.y();
  image.covariance(0, 1) = -image.covariance(0, 1);
  image.covariance(1, 0) = -image.covariance(1, 0);
  image.right_wall_rad = -breakpoint.left_wall_rad;
  image.left_wall_rad = -breakpoint.right_wall_rad;
  std::swap(image.wall_on_right, image.wall_on_left);
  std::swap(image.right_support, image.left_support);
  return image;
}

}  // namespace cornerd::core
