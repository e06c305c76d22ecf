// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "survey/mapped_face.hpp"

namespace cornerd::survey {

/// Where the lidar was in a turn, by the faces that the map has already.
struct ScanMatch {
  core::Pose2 T_map_lidar;
  core::Covariance3 covariance = core::Covariance3::Zero();
  double matched_share = 0;  ///< of the samples on sighted walls: those on faces of the map
  bool valid = false;        ///< false: too little was matched to say more than the prior did
  /// Of the place, in the direction that the walls tell least of, by what was seen alone; infinite
  /// where they tell nothing of it.
  double own_sigma_m = std::numeric_limits<double>::infinity();

  /// The turn's own walls tell where it is, each way.
  bool by_walls() const;
};

/// How far off a prediction may be.
struct Reach {
  double place_m = 0.1;
  double heading_rad = core::radians(8);
};

/// Matches the walls of one turn to the faces of the map: a wall belongs to a face that looks the
/// same way, lies on the same line and overlaps it.
class ScanMatcher {
 public:
  /// A sighting beside a face, which may be its next piece, then tells nothing of the place.
  void set_cautious(bool cautious) { cautious_ = cautious; }

  /// `faces_of`: for each sighting the face that it is of, or kNoFace.
  ScanMatch match(std::span<const Sighting> sightings, std::span<const MappedFace> faces,
                  const core::Pose2& prior, const core::Covariance3& covariance, const Reach& reach,
                  std::vector<std::uint32_t>& faces_of) const;

  /// The faces alone, for a pose that is known.
  /// Returns the share of the samples that are on faces.
  static double assign(std::span<const Sighting> sightings, std::span<const MappedFace> faces,
                       const core::Pose2& T_map_lidar, const Reach& reach,
                       std::vector<std::uint32_t>& faces_of);

 private:
  bool cautious_ = false;
};

/// A pose that is known but for what is left after an adjustment.
inline constexpr Reach kExactReach{0.02, core::radians(1)};

}  // namespace cornerd::survey
