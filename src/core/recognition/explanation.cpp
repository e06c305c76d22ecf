// SPDX-License-Identifier: MIT
#include "core/recognition/explanation.hpp"

#include <algorithm>
#include <cmath>

namespace cornerd::core {
namespace {

/// What a ray does when the place is right: shares of a usual indoor turn, with a wide margin.
constexpr double kHitShare = 0.7;
constexpr double kNearShare = 0.15;
constexpr double kShortShare = 0.1;
constexpr double kOtherShare = 0.05;
/// A wall may be this far off where the map has it (a standard deviation); so may all walls of a
/// turn that was taken in motion.
constexpr double kNearSigma_m = 0.03;
constexpr double kNearSigmas = 2.5;
/// What stands in front of a wall may stand anywhere: this much of the way counts, whatever the
/// distance, so that no place gains by having its walls near.
constexpr double kShortSpan_m = 2;
/// One thing hides many rays: after this many in a row the next one is no news, and counts for a
/// fraction where things are counted. By rays alone a closed door weighs the more the nearer the
/// robot is to it, and a room that is symmetric but for its door would be entered backwards.
constexpr std::size_t kFreshRays = 4;
constexpr double kStaleShare = 0.01;
/// A range that nothing explains may be anything that an A1 can measure.
constexpr double kOtherSpan_m = 12;
constexpr double kHitSigmas = 4;
/// Least standard deviation of a range: what walls are off their place in any map.
constexpr double kMapSigma_m = 0.003;
/// The beam's own width at a wall's edge makes ranges that belong to neither side.
constexpr double kMinIncidenceSine = 0.05;

const double kLogHitShare = std::log(kHitShare);
const double kLogNearShare = std::log(kNearShare);
const double kLogShort = std::log(kShortShare / kShortSpan_m);
const double kLogOther = std::log(kOtherShare / kOtherSpan_m);
const double kLogRootTwoPi = std::log(std::sqrt(kTwoPi));
/// Below this a hit is likelier than something near whatever their variances are, for a near one's
/// is the greater.
const double kSurelyHitSquare = 2 * (kLogHitShare - kLogNearShare);

/// The sum of many numbers' logarithms: they are multiplied, and one logarithm is taken for some
/// dozens of them. Logarithms were two thirds of the cost of explaining a turn.
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

BeamLikelihood beam_likelihood(const WallMap& map, std::span<const PolarPoint> points,
                               std::span<const PredictedHit> hits, const Pose2& T_map_lidar,
                               const SensorNoise& noise, double noise_scale, double extra_sigma_m) {
  const double c = std::cos(T_map_lidar.theta_rad);
  const double s = std::sin(T_map_lidar.theta_rad);
  std::size_t hidden_in_a_row = 0;
  SumOfLogarithms variances;  // of hits and near ones
  SumOfLogarithms sigmas;     // of hits that things were in the way of
  BeamLikelihood result;
  result.rays = points.size();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const PolarPoint& point = points[i];
    const auto add = [&](double log_density) {
      result.log_likelihood += log_density;
      result.log_likelihood_of_obstacles += log_density;
    };
    const auto add_hidden = [&](double log_density) {
      ++result.shorts;
      result.log_likelihood += log_density;
      if (++hidden_in_a_row <= kFreshRays) {
        result.log_likelihood_of_obstacles += log_density;
        return;
      }
      // What a ray of this range would have given at a wall, but for the logarithm of its sigma.
      const double usual = kLogHitShare - kLogRootTwoPi - 0.5;
      result.log_likelihood_of_obstacles += usual + kStaleShare * (log_density - usual);
      sigmas.add(noise.sigma_range_m(point.range_m));
    };
    if (hits[i].face == PredictedHit::kNone) {
      // Beyond all walls: whatever it was, the map does not have it.
      add_hidden(kLogOther);
      continue;
    }
    const Vec2& normal = map.faces()[hits[i].face].normal;
    const double sine =
        std::max(kMinIncidenceSine, std::abs(normal.x() * (c * point.ray_x - s * point.ray_y) +
                                             normal.y() * (s * point.ray_x + c * point.ray_y)));
    const double variance = noise.variance_across_m2(hits[i].range_m, sine) / (sine * sine) *
                                noise_scale * noise_scale +
                            kMapSigma_m * kMapSigma_m + extra_sigma_m * extra_sigma_m;
    const double error_m = point.range_m - hits[i].range_m;
    const double z_square = error_m * error_m / variance;
    const double near_variance = kNearSigma_m * kNearSigma_m + variance;
    if (z_square < kHitSigmas * kHitSigmas) {
      ++result.hits;
    } else if (error_m * error_m < kNearSigmas * kNearSigmas * near_variance) {
      ++result.near_hits;
    } else if (error_m < 0) {
      add_hidden(kLogShort);
      continue;
    } else {
      ++result.free_space_violations;
      add(kLogOther);
      continue;
    }
    hidden_in_a_row = 0;
    const double near_z_square = error_m * error_m / near_variance;
    const double ahead = kSurelyHitSquare - z_square + near_z_square;
    if (ahead > 0 || ahead + std::log(near_variance / variance) > 0) {
      variances.add(variance);
      add(kLogHitShare - kLogRootTwoPi - z_square / 2);
    } else {
      variances.add(near_variance);
      add(kLogNearShare - kLogRootTwoPi - near_z_square / 2);
    }
  }
  result.log_likelihood -= variances.value() / 2;
  result.log_likelihood_of_obstacles -= variances.value() / 2 + (1 - kStaleShare) * sigmas.value();
  return result;
}

}  // namespace cornerd::core
