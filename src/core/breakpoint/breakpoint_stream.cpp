// SPDX-License-Identifier: MIT
#include "core/breakpoint/breakpoint_stream.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/breakpoint/detector.hpp"

namespace cornerd::core {

BreakpointStream::BreakpointStream(const DetectorConfig& config, const SensorNoise& noise)
    : tracker_(config, noise), polyline_(config, noise) {
  mirrored_.reserve(kMaxBreakpointsPerScan);
}

void BreakpointStream::begin(double spacing_rad, Sweep sweep) {
  sweep_ = sweep;
  tracker_.begin();
  polyline_.begin();
  scan_.begin(spacing_rad);
  detection_.clear();
  buffered_ = 0;
  started_ = false;
  finished_ = false;
}

std::span<const Breakpoint> BreakpointStream::add(double bearing_rad, double range_m) {
  const std::size_t known_count = detection_.breakpoints.size();
  if (finished_ || !(range_m > 0) || !std::isfinite(range_m) || !std::isfinite(bearing_rad)) {
    return new_breakpoints(known_count);
  }
  const double angle_rad = static_cast<int>(sweep_) * bearing_rad;
  if (!started_) {
    started_ = true;
    begin_rad_ = max_sweep_rad_ = angle_rad;
  }
  // Bearings wrap, the sweep angle does not.
  const Return item{max_sweep_rad_ + angle_between(max_sweep_rad_, angle_rad), range_m};
  max_sweep_rad_ = std::max(max_sweep_rad_, item.sweep_rad);
  if (item.sweep_rad >= begin_rad_ + kTwoPi || item.sweep_rad < begin_rad_ - kMaxStepBack_rad) {
    return new_breakpoints(known_count);
  }

  if (buffered_ == reorder_buffer_.size()) {
    take(reorder_buffer_[0]);
    std::move(reorder_buffer_.begin() + 1, reorder_buffer_.begin() + buffered_,
              reorder_buffer_.begin());
    --buffered_;
  }
  std::size_t slot = buffered_++;
  for (; slot > 0 && reorder_buffer_[slot - 1].sweep_rad > item.sweep_rad; --slot) {
    reorder_buffer_[slot] = reorder_buffer_[slot - 1];
  }
  reorder_buffer_[slot] = item;

  std::size_t taken = 0;
  while (taken < buffered_ &&
         reorder_buffer_[taken].sweep_rad < max_sweep_rad_ - kMaxStepBack_rad) {
    take(reorder_buffer_[taken++]);
  }
  std::move(reorder_buffer_.begin() + taken, reorder_buffer_.begin() + buffered_,
            reorder_buffer_.begin());
  buffered_ -= taken;
  if (taken > 0) feed(tracker_, polyline_, scan_, /*ended=*/false, detection_);
  return new_breakpoints(known_count);
}

void BreakpointStream::take(const Return& item) {
  // A sample later than the reorder buffer allows is dropped: tracked walls stay as they are.
  if (scan_.size() > 0 && item.sweep_rad < scan_[scan_.size() - 1].bearing_rad) return;
  scan_.append(item.sweep_rad, item.range_m);
}

std::span<const Breakpoint> BreakpointStream::finish() {
  const std::size_t known_count = detection_.breakpoints.size();
  if (finished_) return new_breakpoints(known_count);
  finished_ = true;
  for (std::size_t i = 0; i < buffered_; ++i) take(reorder_buffer_[i]);
  buffered_ = 0;
  feed(tracker_, polyline_, scan_, /*ended=*/true, detection_);
  detection_.noise_scale = tracker_.noise_scale();
  polyline_.finish(scan_, detection_.noise_scale, detection_);
  return new_breakpoints(known_count);
}

std::span<const Breakpoint> BreakpointStream::new_breakpoints(std::size_t known_count) {
  const std::span<const Breakpoint> found = std::span(detection_.breakpoints).subspan(known_count);
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
