// SPDX-License-Identifier: MIT
#include "core/recognition/beam_likelihood.hpp"

#include <algorithm>
#include <cmath>

namespace cornerd::core {
namespace {

/// What a ray does when the place is right: shares of a usual indoor scan, with a wide margin.
constexpr double kHitShare = 0.7;
constexpr double kNearShare = 0.15;
constexpr double kShortShare = 0.1;
constexpr double kOtherShare = 0.05;
/// A wall may be this far off where the map has it (a standard deviation); so may all walls of a
/// scan that was taken in motion.
constexpr double kNearSigma_m = 0.03;
constexpr double kNearSigmas = 2.5;
/// What stands in front of a wall may stand anywhere: this much of the way counts, whatever the
/// distance, so that no place gains by having its walls near.
constexpr double kShortSpan_m = 2;
/// A range that nothing explains may be anything that an A1 can measure.
constexpr double kOtherSpan_m = 12;
constexpr double kHitSigmas = 4;
/// Least standard deviation of a range: what walls are off their place in any map.
constexpr double kMapSigma_m = 0.003;
/// The beam's own width at a wall's edge makes ranges that belong to neither side.
constexpr double kMinIncidenceSine = 0.05;

/// Half of the rays on walls, as the rest may be people and chairs, and hardly any through one. The
/// two walls of one corner fit any other corner, so that of few rays more than half.
constexpr std::size_t kMinSurplus = 30;
constexpr double kMinHitShare = 0.25;
constexpr double kMaxViolations = 0.08;
/// A place with a lower share of hits than outliers and mixed pixels explain, or with few hits, may
/// be the wrong one of several: rooms of one building share walls.
constexpr double kCertainHitShare = 0.97;
constexpr double kCertainHitShareExpected = 0.9;
constexpr std::size_t kCertainHits = 100;

const double kLogHitShare = std::log(kHitShare);
const double kLogNearShare = std::log(kNearShare);
const double kLogShort = std::log(kShortShare / kShortSpan_m);
const double kLogOther = std::log(kOtherShare / kOtherSpan_m);
const double kLogRootTwoPi = std::log(std::sqrt(kTwoPi));
/// Below this a hit is likelier than something near whatever their variances are, for a near one's
/// is the greater.
const double kSurelyHitSquare = 2 * (kLogHitShare - kLogNearShare);

/// The sum of many numbers' logarithms: they are multiplied, and one logarithm is taken for some
/// dozens of them. Logarithms were two thirds of the cost.
class SumOfLogarithms {
 public:
  void add(double number) {
    product_ *= number;
    if (product_ > 1e-200 && product_ < 1e200) return;
    sum_ += std::log(product_);
    product_ = 1;
  }
  double value() const { return sum_ + std::log(product_); }

 private:
  double sum_ = 0;
  double product_ = 1;
};

}  // namespace

bool BeamLikelihood::explains_scan() const {
  const std::size_t on_walls = hits + near_hits;
  return on_walls >= rays - on_walls + kMinSurplus && hit_share() >= kMinHitShare &&
         violation_share() <= kMaxViolations;
}

bool BeamLikelihood::is_conclusive(bool expected) const {
  return hits >= kCertainHits &&
         hit_share() >= (expected ? kCertainHitShareExpected : kCertainHitShare);
}

BeamLikelihood beam_likelihood(const WallMap& map, std::span<const PolarPoint> points,
                               std::span<const PredictedHit> hits, const Pose2& T_map_lidar,
                               const SensorNoise& noise, double noise_scale) {
  const double c = std::cos(T_map_lidar.theta_rad);
  const double s = std::sin(T_map_lidar.theta_rad);
  SumOfLogarithms variances;  // of hits and near ones
  BeamLikelihood result;
  result.rays = points.size();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const PolarPoint& point = points[i];
    if (hits[i].face == PredictedHit::kNone) {
      // Beyond all walls: whatever it was, the map does not have it.
      ++result.shorts;
      result.log_likelihood += kLogOther;
      continue;
    }
    const Vec2& normal = map.faces()[hits[i].face].normal;
    const double sine =
        std::max(kMinIncidenceSine, std::abs(normal.x() * (c * point.ray_x - s * point.ray_y) +
                                             normal.y() * (s * point.ray_x + c * point.ray_y)));
    const double variance = noise.variance_across_m2(hits[i].range_m, sine) / (sine * sine) *
                                noise_scale * noise_scale +
                            kMapSigma_m * kMapSigma_m;
    const double error_m = point.range_m - hits[i].range_m;
    const double z_square = error_m * error_m / variance;
    const double near_variance = kNearSigma_m * kNearSigma_m + variance;
    if (z_square < kHitSigmas * kHitSigmas) {
      ++result.hits;
    } else if (error_m * error_m < kNearSigmas * kNearSigmas * near_variance) {
      ++result.near_hits;
    } else if (error_m < 0) {
      ++result.shorts;
      result.log_likelihood += kLogShort;
      continue;
    } else {
      ++result.free_space_violations;
      result.log_likelihood += kLogOther;
      continue;
    }
    const double near_z_square = error_m * error_m / near_variance;
    const double ahead = kSurelyHitSquare - z_square + near_z_square;
    if (ahead > 0 || ahead + std::log(near_variance / variance) > 0) {
      variances.add(variance);
      result.log_likelihood += kLogHitShare - kLogRootTwoPi - z_square / 2;
    } else {
      variances.add(near_variance);
      result.log_likelihood += kLogNearShare - kLogRootTwoPi - near_z_square / 2;
    }
  }
  result.log_likelihood -= variances.value() / 2;
  return result;
}

}  // namespace cornerd::core
