// SPDX-License-Identifier: MIT
#include "core/breakpoint/wall_chain.hpp"

#include <cmath>

#include "core/breakpoint/extraction.hpp"
#include "core/breakpoint/wall_tests.hpp"

namespace cornerd::core {
namespace {

/// Samples looked at on each side of a border.
constexpr int kBorderSamples = 4;
/// A wall gives no more away than leaves it this many.
constexpr std::uint32_t kKeptSamples = 4;

}  // namespace

WallChain::WallChain(const DetectorConfig& config, const SensorNoise& noise)
    : config_(config), angles_(config.extraction), noise_(noise) {
  walls_.reserve(kMaxSegmentsPerScan);
}

void WallChain::begin() {
  walls_.clear();
  settled_ = 0;
  reported_ = 1;
  holds_first_ = true;
}

void WallChain::add(const PolarScan& scan, const SegmentTrack& wall, double noise_scale,
                    Detection& detection) {
  added_ = wall;
  SegmentTrack next = wall;
  while (walls_.size() >= 2 &&
         dissolve(scan, walls_.size() - 2, walls_.size() - 1, next, noise_scale)) {
    walls_.pop_back();
  }
  if (!walls_.empty() && is_one_wall(scan, judgement(noise_scale), walls_.back(), next)) {
    append(walls_.back(), next);
    return;
  }
  if (!keep_wall(next, walls_)) {
    ++detection.overflowed;
    return;
  }
  const bool doubtful = is_doubtful(next, config_.extraction, noise_scale);
  advance(scan, walls_.size() - (doubtful ? 1 : 0), noise_scale, detection);
}

void WallChain::grow(const SegmentTrack& wall) {
  if (walls_.empty()) return;
  SegmentTrack& last = walls_.back();
  if (last.last != added_.last) return;  // it did not fit
  last.fit.add(wall.fit.without(added_.fit));
  last.line = last.fit.line();
  last.last = wall.last;
  last.support += wall.support - added_.support;
  added_ = wall;
}

/// A short wall between two others whose samples all lie on these is none: it is noise that looked
/// like a line, or the rounding of a corner.
bool WallChain::dissolve(const PolarScan& scan, std::size_t before, std::size_t doubtful,
                         SegmentTrack& after, double noise_scale) {
  const SegmentTrack wall = walls_[doubtful];
  SegmentTrack& right = walls_[before];
  if (!is_doubtful(wall, config_.extraction, noise_scale)) return false;
  if (before == doubtful || right.support <= wall.support) return false;
  const std::size_t split = split_between(scan, judgement(noise_scale), right, wall, after);
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

/// Gives each sample at the border of two neighbouring walls to the wall that it lies on. A tracker
/// runs a sample or two around a corner before it notices.
void WallChain::settle(const PolarScan& scan, SegmentTrack& right, SegmentTrack& left) const {
  if (samples_between(scan, right, left) > config_.extraction.max_interruption) return;
  const std::size_t n = scan.size();
  // A sample at the border of one wall that lies on the other's line, and not far from it.
  const auto belongs = [&](std::uint32_t index, const SegmentTrack& from, const SegmentTrack& to) {
    const PolarPoint& point = scan[index];
    const PolarPoint& end = scan[&to == &left ? left.first : right.last];
    const double gap_m = std::hypot(point.x_m - end.x_m, point.y_m - end.y_m);
    return gap_m < config_.extraction.max_piece_gap_m &&
           misfit(noise_, to.line, point) < misfit(noise_, from.line, point);
  };
  const std::uint32_t before = right.support;
  for (int k = 0; k < kBorderSamples && right.support > kKeptSamples; ++k) {
    if (!belongs(right.last, right, left)) break;
    right.take_back(scan, right.last, noise_);
    left.add_in_front(scan, right.last, noise_);
    right.last = static_cast<std::uint32_t>((right.last + n - 1) % n);
  }
  const bool gave = right.support < before;
  for (int k = 0; k < kBorderSamples && left.support > kKeptSamples && !gave; ++k) {
    if (!belongs(left.first, left, right)) break;
    left.take_back(scan, left.first, noise_);
    right.add(scan, left.first, noise_);
    left.first = static_cast<std::uint32_t>((left.first + 1) % n);
  }
  if (right.support == before) return;
  right.line = right.fit.line();
  left.line = left.fit.line();
}

/// Of the walls below `certain` none can dissolve any more. A border is what it is when both its
/// walls have all their samples, those at their other ends as well.
void WallChain::advance(const PolarScan& scan, std::size_t certain, double noise_scale,
                        Detection& detection) {
  for (; settled_ + 1 < certain; ++settled_) {
    settle(scan, walls_[settled_], walls_[settled_ + 1]);
  }
  for (; reported_ + 1 < settled_; ++reported_) report(scan, reported_, noise_scale, detection);
}

void WallChain::report(const PolarScan& scan, std::size_t right, double noise_scale,
                       Detection& detection) {
  const SegmentTrack& left = walls_[(right + 1) % walls_.size()];
  extract_border(scan, walls_[right], left, config_.corner_tolerance_m, judgement(noise_scale),
                 detection);
}

void WallChain::close_seam(const PolarScan& scan, double noise_scale) {
  const auto remove_front = [&] {
    walls_.erase(walls_.begin());
    settled_ -= settled_ > 0 ? 1 : 0;
    --reported_;
    holds_first_ = false;
  };
  while (walls_.size() >= 2 &&
         is_one_wall(scan, judgement(noise_scale), walls_.back(), walls_.front())) {
    append(walls_.back(), walls_.front());
    remove_front();
  }
  const std::size_t n = walls_.size();
  if (n >= 3 && settled_ + 1 < n && dissolve(scan, n - 2, n - 1, walls_.front(), noise_scale)) {
    walls_.pop_back();
  }
  if (walls_.size() >= 3 && holds_first_ &&
      dissolve(scan, walls_.size() - 1, 0, walls_[1], noise_scale)) {
    remove_front();
  }
}

void WallChain::finish(const PolarScan& scan, double noise_scale, Detection& detection) {
  close_seam(scan, noise_scale);
  if (walls_.size() >= 2) {
    for (; settled_ < walls_.size(); ++settled_) {
      settle(scan, walls_[settled_], walls_[(settled_ + 1) % walls_.size()]);
    }
    for (; reported_ < walls_.size(); ++reported_) {
      report(scan, reported_, noise_scale, detection);
    }
    if (holds_first_) report(scan, 0, noise_scale, detection);
  }
  for (const SegmentTrack& wall : walls_) {
    detection.segments.push_back(describe_wall(scan, wall, noise_scale));
  }
}

}  // namespace cornerd::core
