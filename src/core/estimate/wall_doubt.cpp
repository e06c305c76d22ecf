// SPDX-License-Identifier: MIT
#include "core/estimate/wall_doubt.hpp"

#include <algorithm>
#include <cmath>

#include "core/geometry/squared.hpp"

namespace cornerd::core {
namespace {

/// Of points with Gaussian noise of one sigma, weighted by Tukey's biweight cut at four: the
/// variance of their weighted distances' sum, as a share of the sum of their weights; and what that
/// sum grows by with the face's own distance, likewise. Moments of the normal distribution:
/// E[(1 - z^2/16)^4 z^2] = 0.513 and E[(1 - z^2/16) (1 - 5 z^2/16)] = 0.684 over
/// E[(1 - z^2/16)^2] = 0.887.
constexpr double kNoiseShare = 0.579;
constexpr double kShiftShare = 0.771;

/// Of what the turns before said, with each turn: three seconds.
constexpr double kKept = 0.95;

}  // namespace

WallResiduals residuals_of_walls(std::span<FacePull> pulls, const Covariance3& covariance) {
  std::sort(pulls.begin(), pulls.end(),
            [](const FacePull& one, const FacePull& other) { return one.face < other.face; });
  WallResiduals walls;
  Covariance3 per_m2 = Covariance3::Zero();
  for (std::size_t begin = 0, end = 0; begin < pulls.size(); begin = end) {
    FacePull sum = pulls[begin];
    for (end = begin + 1; end < pulls.size() && pulls[end].face == sum.face; ++end) {
      sum.weight += pulls[end].weight;
      sum.lever += pulls[end].lever;
      sum.distance += pulls[end].distance;
    }
    if (!(sum.weight > 0)) continue;
    const Eigen::Vector3d pull(sum.weight * sum.normal.x(), sum.weight * sum.normal.y(), sum.lever);
    // The pose has followed the face by this share, and left so much less of its distance.
    const double followed = pull.dot(covariance * pull) / sum.weight;
    const double noise = kNoiseShare * (1 - followed);
    walls.excess += squared(sum.distance) / sum.weight - noise;
    walls.chance += 2 * squared(noise);
    walls.per_m2 += squared(kShiftShare) * sum.weight * (1 - followed);
    per_m2 += pull * pull.transpose();
  }
  walls.covariance_per_m2 = covariance * per_m2 * covariance;
  return walls;
}

void WallDoubt::add(const WallResiduals& seen) {
  excess_ = kKept * excess_ + seen.excess;
  chance_ = squared(kKept) * chance_ + seen.chance;
  per_m2_ = kKept * per_m2_ + seen.per_m2;
}

double WallDoubt::variance_m2() const {
  // Half of all turns have some excess by chance.
  const double excess = excess_ - std::sqrt(chance_);
  return excess > 0 && per_m2_ > 0 ? excess / per_m2_ : 0;
}

Covariance3 WallDoubt::doubt_of(const WallResiduals& seen) const {
  return variance_m2() * seen.covariance_per_m2;
}

}  // namespace cornerd::core
