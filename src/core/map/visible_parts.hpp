// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

namespace cornerd::core {

/// Part of an edge, as shares of its length.
struct Interval {
  double begin = 0;
  double end = 1;
};

/// The parts of an edge that no box covers.
class VisibleParts {
 public:
  /// `shortest`: a share of the length; shorter parts are left out.
  explicit VisibleParts(double shortest) : shortest_(shortest), parts_{{0, 1}} {}

  /// Those within `range`.
  std::vector<Interval> within(const Interval& range) const {
    std::vector<Interval> found;
    for (const Interval& part : parts_) {
      const Interval common{std::max(part.begin, range.begin), std::min(part.end, range.end)};
      if (common.begin < common.end) found.push_back(common);
    }
    return found;
  }
  double length_within(const Interval& range) const {
    double length = 0;
    for (const Interval& part : parts_) {
      length += std::max(0.0, std::min(part.end, range.end) - std::max(part.begin, range.begin));
    }
    return length;
  }
  std::span<const Interval> parts() const { return parts_; }

  void hide(const Interval& hidden) {
    if (hidden.begin >= hidden.end) return;
    for (std::size_t i = parts_.size(); i-- > 0;) {
      const Interval part = parts_[i];
      if (hidden.end <= part.begin || hidden.begin >= part.end) continue;
      parts_.erase(parts_.begin() + static_cast<std::ptrdiff_t>(i));
      insert(i, {hidden.end, part.end});
      insert(i, {part.begin, hidden.begin});
    }
  }

 private:
  void insert(std::size_t place, const Interval& part) {
    if (part.end - part.begin <= shortest_) return;
    parts_.insert(parts_.begin() + static_cast<std::ptrdiff_t>(place), part);
  }

  double shortest_;
  std::vector<Interval> parts_;
};

}  // namespace cornerd::core
