// SPDX-License-Identifier: MIT
#include "bench/scoring.hpp"

#include <algorithm>

namespace cornerd::bench {
namespace {

using core::BreakpointKind;
using replay::CornerObservation;
using replay::CornerView;

double share(std::size_t part, std::size_t whole) {
  return whole == 0 ? 1 : static_cast<double>(part) / static_cast<double>(whole);
}

bool shows_both_walls(const CornerObservation& corner) {
  return corner.view == CornerView::kSupported || corner.view == CornerView::kVisible;
}

}  // namespace

template <typename Eligible, typename Position, typename Take>
void CornerScore::match(std::span<const core::Breakpoint> breakpoints, std::size_t candidates,
                        Eligible&& eligible, Position&& position, Take&& take) {
  pairs_.clear();
  for (std::uint32_t d = 0; d < breakpoints.size(); ++d) {
    if (detection_taken_[d]) continue;
    for (std::uint32_t c = 0; c < candidates; ++c) {
      if (!eligible(c)) continue;
      const double distance_m = (breakpoints[d].position - position(c)).norm();
      if (distance_m <= kMatchDistance_m) pairs_.push_back({distance_m, d, c});
    }
  }
  std::sort(pairs_.begin(), pairs_.end(), [](const Pair& a, const Pair& b) {
    if (a.distance_m != b.distance_m) return a.distance_m < b.distance_m;
    return a.detection != b.detection ? a.detection < b.detection : a.corner < b.corner;
  });
  corner_taken_.assign(candidates, false);
  for (const Pair& pair : pairs_) {
    if (detection_taken_[pair.detection] || corner_taken_[pair.corner]) continue;
    detection_taken_[pair.detection] = true;
    corner_taken_[pair.corner] = true;
    take(pair);
  }
}

std::span<const Verdict> CornerScore::add(std::span<const core::Breakpoint> breakpoints,
                                          const replay::CornerTruth& truth) {
  const auto corners = truth.corners();
  const auto shadows = truth.occlusion_edges();
  ++scans_;
  for (const CornerObservation& corner : corners) {
    supported_ += corner.view == CornerView::kSupported ? 1 : 0;
    visible_ += shows_both_walls(corner) ? 1 : 0;
  }

  verdicts_.assign(breakpoints.size(), Verdict::kFalse);
  detection_taken_.assign(breakpoints.size(), false);
  const auto corner_position = [&](std::uint32_t c) { return corners[c].position; };
  match(
      breakpoints, corners.size(), [&](std::uint32_t c) { return shows_both_walls(corners[c]); },
      corner_position,
      [&](const Pair& pair) {
        verdicts_[pair.detection] = Verdict::kTrue;
        errors_m_.push_back(pair.distance_m);
        supported_found_ += corners[pair.corner].view == CornerView::kSupported ? 1 : 0;
        ++visible_found_;
      });
  match(
      breakpoints, corners.size(), [&](std::uint32_t c) { return !shows_both_walls(corners[c]); },
      corner_position, [&](const Pair& pair) { verdicts_[pair.detection] = Verdict::kOneSided; });
  match(
      breakpoints, shadows.size(), [](std::uint32_t) { return true; },
      [&](std::uint32_t c) { return shadows[c]; },
      [&](const Pair& pair) { verdicts_[pair.detection] = Verdict::kOcclusionEdge; });

  for (std::size_t d = 0; d < breakpoints.size(); ++d) {
    ++counts_[index(breakpoints[d].kind)][static_cast<std::size_t>(verdicts_[d])];
  }
  return verdicts_;
}

void CornerScore::merge(const CornerScore& other) {
  scans_ += other.scans_;
  for (std::size_t kind = 0; kind < counts_.size(); ++kind) {
    for (std::size_t i = 0; i < counts_[kind].size(); ++i) {
      counts_[kind][i] += other.counts_[kind][i];
    }
  }
  supported_ += other.supported_;
  visible_ += other.visible_;
  supported_found_ += other.supported_found_;
  visible_found_ += other.visible_found_;
  errors_m_.insert(errors_m_.end(), other.errors_m_.begin(), other.errors_m_.end());
}

std::size_t CornerScore::detections(Verdict verdict) const {
  return detections(BreakpointKind::kCorner, verdict) +
         detections(BreakpointKind::kTerminal, verdict);
}

double CornerScore::precision(bool strictly) const {
  const std::size_t found = detections(Verdict::kTrue);
  const std::size_t aside = strictly ? detections(Verdict::kOneSided) : 0;
  return share(found, found + detections(Verdict::kFalse) + aside);
}

double CornerScore::precision_of_corners(bool strictly) const {
  constexpr BreakpointKind kKind = BreakpointKind::kCorner;
  const std::size_t found = detections(kKind, Verdict::kTrue);
  const std::size_t aside = strictly ? detections(kKind, Verdict::kOneSided) : 0;
  return share(found, found + detections(kKind, Verdict::kFalse) + aside);
}

double CornerScore::recall_of_supported() const { return share(supported_found_, supported_); }
double CornerScore::recall_of_visible() const { return share(visible_found_, visible_); }

}  // namespace cornerd::bench
