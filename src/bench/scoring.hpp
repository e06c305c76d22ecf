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

/// Largest distance of a detection from its corner.
inline constexpr double kMatchDistance_m = 0.06;

/// Classification of a detection.
enum class Verdict : std::uint8_t {
  kTrue,           ///< a corner whose walls both give returns
  kFalse,          ///< no corner, or one that has a nearer detection
  kOneSided,       ///< a corner with one visible wall, or an occluded one
  kOcclusionEdge,  ///< where one wall occludes another: neither true nor false
};

/// Detections in many scans against the true corners.
class CornerScore {
 public:
  /// `breakpoints` and `truth` in the lidar frame. Each corner matches one detection at most:
  /// nearest pairs first, corners with both walls visible before others. Returns a verdict for each
  /// breakpoint, valid until the next call.
  std::span<const Verdict> add(std::span<const core::Breakpoint> breakpoints,
                               const replay::CornerTruth& truth);
  void merge(const CornerScore& other);

  std::size_t scans() const { return scans_; }
  std::size_t detections(core::BreakpointKind kind, Verdict verdict) const {
    return counts_[index(kind)][static_cast<std::size_t>(verdict)];
  }
  std::size_t detections(Verdict verdict) const;

  std::size_t supported() const { return supported_; }  ///< corners whose walls both give 5 returns
  std::size_t missed() const { return supported_ - supported_found_; }  ///< of the supported
  std::size_t visible() const { return visible_; }  ///< corners whose walls both give a return

  /// Share of the detections that are true corners. Those of kOneSided are left out, or count as
  /// false where `strictly`. 1 where nothing was detected.
  double precision(bool strictly = false) const;
  /// The same for detections of the kind "corner" alone.
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
