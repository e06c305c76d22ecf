// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>

#include "core/geometry/pose2.hpp"

namespace cornerd::core {

/// What the points before one face say of the lidar's pose.
struct FacePull {
  std::uint32_t face = 0;
  Vec2 normal;
  double weight = 0;    ///< 1/m^2, of the points' biweights
  double lever = 0;     ///< times the weight: how far a small turn moves the points to the face
  double distance = 0;  ///< times the weight: how far in front of the face the points are
};

/// What a refined turn says of faces that are not where the map has them. All points of such a face
/// are off together, which no number of them averages out: walls that were measured by hand, a
/// range's bias that is not learnt, a turn smeared by its motion.
struct WallResiduals {
  double excess = 0;  ///< of the faces' mean distances, beyond what the points' noise explains
  double chance = 0;  ///< variance of the excess where no face is off
  double per_m2 = 0;  ///< what faces off by a variance of 1 m^2 would add to it
  /// What such faces add to the covariance of the pose (x, y, theta).
  Covariance3 covariance_per_m2 = Covariance3::Zero();
};

/// `pulls`: at the refined pose; their order is changed. `covariance`: of that pose by the points'
/// noise alone.
WallResiduals residuals_of_walls(std::span<FacePull> pulls, const Covariance3& covariance);

/// How far off faces are, as the last turns saw them: a turn alone sees too few.
class WallDoubt {
 public:
  void add(const WallResiduals& seen);
  /// To be added to the pose of a turn with these residuals.
  Covariance3 doubt_of(const WallResiduals& seen) const;
  double variance_m2() const;
  void forget() { *this = {}; }

 private:
  double excess_ = 0;  ///< of the turns so far, fading
  double chance_ = 0;
  double per_m2_ = 0;
};

}  // namespace cornerd::core
