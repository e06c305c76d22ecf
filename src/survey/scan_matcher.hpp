// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "survey/line_landmark.hpp"

namespace cornerd::survey {

/// Pose of a scan from the faces that are in the map already.
struct ScanMatch {
  core::Pose2 T_map_lidar;
  core::Covariance3 covariance = core::Covariance3::Zero();
  double matched_share = 0;  ///< of the samples on observed lines: those on faces of the map
  bool valid = false;        ///< false: too little was matched to improve on the prior
  /// Position sigma in the least observable direction, from this scan alone; infinite where that
  /// direction is unobservable.
  double weakest_sigma_m = std::numeric_limits<double>::infinity();

  /// The scan's own walls determine its position in each direction.
  bool is_constrained() const;
};

/// How far off a prediction may be.
struct SearchRadius {
  double place_m = 0.1;
  double heading_rad = core::radians(8);
};

/// Matches the line observations of a scan to the faces of the map. An observation matches a face
/// with the same normal and line that it overlaps.
class ScanMatcher {
 public:
  /// Observations that lie beside a face without overlap then do not constrain the pose.
  void set_requires_overlap(bool cautious) { requires_overlap_ = cautious; }

  /// `faces_of`: for each observation the face that it matches, or kNoFace.
  ScanMatch match(std::span<const LineObservation> observations,
                  std::span<const LineLandmark> faces, const core::Pose2& prior,
                  const core::Covariance3& covariance, const SearchRadius& radius,
                  std::vector<std::uint32_t>& faces_of) const;

  /// Data association at a known pose. Returns the share of the samples that are on faces.
  static double assign(std::span<const LineObservation> observations,
                       std::span<const LineLandmark> faces, const core::Pose2& T_map_lidar,
                       const SearchRadius& radius, std::vector<std::uint32_t>& faces_of);

 private:
  bool requires_overlap_ = false;
};

/// For a pose that is known up to the residuals of an adjustment.
inline constexpr SearchRadius kExactRadius{0.02, core::radians(1)};

}  // namespace cornerd::survey
