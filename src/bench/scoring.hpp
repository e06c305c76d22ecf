// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/breakpoint/breakpoint.hpp"
#include "replay/simulator/corner_truth.hpp"

namespace cornerd::bench {

/// A detection within so much of a corner is that corner.
inline constexpr double kMatchDistance_m = 0.06;

/// What a detection turned out to be.
enum class Verdict : std::uint8_t {
  kTrue,           ///< a corner whose walls both give returns
  kFalse,          ///< nothing, or a corner that another detection has already
  kOneSided,       ///< a corner that is no more than a wall's end from here, or is hidden itself
  kOcclusionEdge,  ///< where one wall hides another: neither true nor false
};

/// What was detected in many turns against what was there.
class CornerScore {
 public:
  /// `breakpoints` in the lidar frame, as is the truth. Each corner belongs to one detection at
  /// most: the nearest pairs are matched first, those of corners seen from both sides before
  /// others. Returns the verdict on each breakpoint, valid until the next call.
  std::span<const Verdict> add(std::span<const core::Breakpoint> breakpoints,
                               const replay::CornerTruth& truth);
  void merge(const CornerScore& other);

  std::size_t scans() const { return scans_; }
  std::size_t detections(core::BreakpointKind kind, Verdict verdict) const {
    return counts_[index(kind)][static_cast<std::size_t>(verdict)];
  }
  std::size_t detections(Verdict verdict) const;

  std::size_t supported() const { return supported_; }  ///< corners, both walls with 5 returns
  std::size_t missed() const { return supported_ - supported_found_; }  ///< of the supported
  std::size_t visible() const { return visible_; }  ///< those included, both walls with one

  /// Share of the detections that are true corners. Those at one-sided wall ends (and hidden
  /// corners) are left out, or are false where `strictly`. 1 where nothing was detected.
  double precision(bool strictly = false) const;
  /// The same of the detections that claim to be corners, not terminals.
  double precision_of_corners(bool strictly = false) const;
  double recall_of_supported() const;
  double recall_of_visible() const;

  /// Distances of the true detections from their corners.
  const std::vector<double>& errors_m() const { return errors_m_; }

 private:
  static std::size_t index(core::BreakpointKind kind) { return static_cast<std::size_t>(kind); }
  struct Pair {
    double distance_m;
    std::uint32_t detection;
    std::uint32_t corner;
  };
  template <typename Eligible, typename Position, typename Take>
  void match(std::span<const core::Breakpoint> breakpoints, std::size_t candidates,
             Eligible&& eligible, Position&& position, Take&& take);

  std::size_t scans_ = 0;
  std::array<std::array<std::size_t, 4>, 2> counts_{};
  std::size_t supported_ = 0;
  std::size_t visible_ = 0;
  std::size_t supported_found_ = 0;
  std::size_t visible_found_ = 0;
  std::vector<double> errors_m_;

  std::vector<Pair> pairs_;
  std::vector<bool> corner_taken_;
  std::vector<bool> detection_taken_;
  std::vector<Verdict> verdicts_;
};

}  // namespace cornerd::bench
