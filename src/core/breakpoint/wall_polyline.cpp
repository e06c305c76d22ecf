// SPDX-License-Identifier: MIT
#include "core/breakpoint/wall_polyline.hpp"

#include <cmath>

#include "core/breakpoint/extraction.hpp"
#include "core/breakpoint/wall_tests.hpp"

namespace cornerd::core {
namespace {

/// Samples tested on each side of a border.
constexpr int kBorderSamples = 4;
/// Smallest support that a wall keeps.
constexpr std::uint32_t kKeptSamples = 4;

}  // namespace

WallPolyline::WallPolyline(const DetectorConfig& config, const SensorNoise& noise)
    : config_(config), angles_(config.extraction), noise_(noise) {
  walls_.reserve(kMaxSegmentsPerScan);
}

void WallPolyline::begin() {
  walls_.clear();
  reassigned_ = 0;
  reported_ = 1;
  has_first_border_ = true;
}

void WallPolyline::add(const PolarScan& scan, const SegmentTrack& wall, double noise_scale,
                       Detection& detection) {
  last_added_ = wall;
  SegmentTrack next = wall;
  while (walls_.size() >= 2 &&
         merge_segments(scan, walls_.size() - 2, walls_.size() - 1, next, noise_scale)) {
    walls_.pop_back();
  }
  if (!walls_.empty() && is_one_wall(scan, context(noise_scale), walls_.back(), next)) {
    append(walls_.back(), next);
    return;
  }
  if (!keep_wall(next, walls_)) {
    ++detection.overflowed;
    return;
  }
  const bool short_wall = is_short(next, config_.extraction, noise_scale);
  advance(scan, walls_.size() - (short_wall ? 1 : 0), noise_scale, detection);
}

void WallPolyline::extend_last(const SegmentTrack& wall) {
  if (walls_.empty()) return;
  SegmentTrack& last = walls_.back();
  if (last.last != last_added_.last) return;  // the wall was dropped for lack of room
  last.fit.add(wall.fit.without(last_added_.fit));
  last.line = last.fit.line();
  last.last = wall.last;
  last.support += wall.support - last_added_.support;
  last_added_ = wall;
}

/// Splits a short wall between two others among them where all its samples lie on their lines: it
/// is noise that looked like a line, or a rounded corner.
bool WallPolyline::merge_segments(const PolarScan& scan, std::size_t before, std::size_t short_wall,
                                  SegmentTrack& after, double noise_scale) {
  const SegmentTrack wall = walls_[short_wall];
  SegmentTrack& right = walls_[before];
  if (!is_short(wall, config_.extraction, noise_scale)) return false;
  if (before == short_wall || right.support <= wall.support) return false;
  const std::size_t split = split_between(scan, context(noise_scale), right, wall, after);
  if (split == kNoSplit) return false;
  const std::size_t n = scan.size();
  const std::size_t count = (wall.last + n - wall.first) % n + 1;
  for (std::size_t k = 0; k < split; ++k) {
    right.add(scan, (wall.first + k) % n, noise_);
  }
  for (std::size_t k = count; k > split; --k) {
    after.add_in_front(scan, (wall.first + k - 1) % n, noise_);
  }
  right.line = right.fit.line();
  after.line = after.fit.line();
  return true;
}

/// Moves samples at the border of two walls to the wall whose line they lie on. A tracker overruns
/// a corner by a sample or two.
void WallPolyline::reassign_points(const PolarScan& scan, SegmentTrack& right,
                                   SegmentTrack& left) const {
  if (samples_between(scan, right, left) > config_.extraction.max_interruption) return;
  const std::size_t n = scan.size();
  // True for a sample at the border of one wall that lies on the other's line and near its end.
  const auto belongs = [&](std::uint32_t index, const SegmentTrack& from, const SegmentTrack& to) {
    const PolarPoint& point = scan[index];
    const PolarPoint& end = scan[&to == &left ? left.first : right.last];
    const double gap_m = std::hypot(point.x_m - end.x_m, point.y_m - end.y_m);
    return gap_m < config_.extraction.merge_gap_m &&
           mahalanobis_squared(noise_, to.line, point) <
               mahalanobis_squared(noise_, from.line, point);
  };
  const std::uint32_t before = right.support;
  for (int k = 0; k < kBorderSamples && right.support > kKeptSamples; ++k) {
    if (!belongs(right.last, right, left)) break;
    right.remove(scan, right.last, noise_);
    left.add_in_front(scan, right.last, noise_);
    right.last = static_cast<std::uint32_t>((right.last + n - 1) % n);
  }
  const bool gave = right.support < before;
  for (int k = 0; k < kBorderSamples && left.support > kKeptSamples && !gave; ++k) {
    if (!belongs(left.first, left, right)) break;
    left.remove(scan, left.first, noise_);
    right.add(scan, left.first, noise_);
    left.first = static_cast<std::uint32_t>((left.first + 1) % n);
  }
  if (right.support == before) return;
  right.line = right.fit.line();
  left.line = left.fit.line();
}

/// Walls below `certain` cannot merge any more. A border is final when both its walls have all
/// their samples, at both ends.
void WallPolyline::advance(const PolarScan& scan, std::size_t certain, double noise_scale,
                           Detection& detection) {
  for (; reassigned_ + 1 < certain; ++reassigned_) {
    reassign_points(scan, walls_[reassigned_], walls_[reassigned_ + 1]);
  }
  for (; reported_ + 1 < reassigned_; ++reported_) report(scan, reported_, noise_scale, detection);
}

void WallPolyline::report(const PolarScan& scan, std::size_t right, double noise_scale,
                          Detection& detection) {
  const SegmentTrack& left = walls_[(right + 1) % walls_.size()];
  extract_border(scan, walls_[right], left, config_.corner_tolerance_m, context(noise_scale),
                 detection);
}

void WallPolyline::close_seam(const PolarScan& scan, double noise_scale) {
  const auto remove_front = [&] {
    walls_.erase(walls_.begin());
    reassigned_ -= reassigned_ > 0 ? 1 : 0;
    --reported_;
    has_first_border_ = false;
  };
  while (walls_.size() >= 2 &&
         is_one_wall(scan, context(noise_scale), walls_.back(), walls_.front())) {
    append(walls_.back(), walls_.front());
    remove_front();
  }
  const std::size_t n = walls_.size();
  if (n >= 3 && reassigned_ + 1 < n &&
      merge_segments(scan, n - 2, n - 1, walls_.front(), noise_scale)) {
    walls_.pop_back();
  }
  if (walls_.size() >= 3 && has_first_border_ &&
      merge_segments(scan, walls_.size() - 1, 0, walls_[1], noise_scale)) {
    remove_front();
  }
}

void WallPolyline::finish(const PolarScan& scan, double noise_scale, Detection& detection) {
  close_seam(scan, noise_scale);
  if (walls_.size() >= 2) {
    for (; reassigned_ < walls_.size(); ++reassigned_) {
      reassign_points(scan, walls_[reassigned_], walls_[(reassigned_ + 1) % walls_.size()]);
    }
    for (; reported_ < walls_.size(); ++reported_) {
      report(scan, reported_, noise_scale, detection);
    }
    if (has_first_border_) report(scan, 0, noise_scale, detection);
  }
  for (const SegmentTrack& wall : walls_) {
    detection.segments.push_back(describe_wall(scan, wall, noise_scale));
  }
}

}  // namespace cornerd::core
