// SPDX-License-Identifier: MIT
#include "core/breakpoint/altbd.hpp"

#include <algorithm>
#include <cmath>

namespace cornerd::core {
namespace {

/// Samples that start a line; fewer have no residual, more span the short faces of thin walls.
constexpr std::uint32_t kSeedSize = 3;
/// Misses in a row that end a wall: outliers come alone, mixed pixels in twos.
constexpr std::uint32_t kMissesToBreak = 3;
/// A ray closer to the wall's direction than this tells nothing of where it meets the wall.
constexpr double kMinSine = 0.03;
/// The noise model counts like this many residuals of its own when the turn's noise is judged.
constexpr double kPriorResiduals = 20;
/// A bearing gap over which a wall is not followed: a door's width at a usual distance.
constexpr double kMaxGap_rad = radians(25);

}  // namespace

/// Where the next ray should meet the tracked wall, and how far off it may be (steps 5-9).
struct Altbd::Prediction {
  bool valid = false;
  double residual_m = 0;    ///< measured minus predicted range
  double along_share = 0;   ///< of the residual, along the wall: cosine of the incidence
  double across_share = 0;  ///< across the wall: sine of the incidence
  double variance_m2 = 0;   ///< of the residual across the wall
  double major_m = 0;       ///< q_max: axis along the wall
  double minor_m = 0;       ///< h_max: axis across the wall

  bool inside_ellipse() const {
    const double k = residual_m * along_share / major_m;
    const double j = residual_m * across_share / minor_m;
    return k * k + j * j <= 1;
  }
};

Altbd::Altbd(const DetectorConfig& config, const SensorNoise& noise)
    : config_(config), noise_(noise) {}

double Altbd::noise_scale() const {
  return std::sqrt((kPriorResiduals + residual_sum_) / (kPriorResiduals + residual_count_));
}

Altbd::Prediction Altbd::predict(const PolarScan& scan, std::size_t index) const {
  Prediction prediction;
  const PolarPoint& point = scan[index];
  const PolarPoint& before = scan[current_.last];
  const Line& line = current_.line;
  const Vec2 ray(point.ray_x, point.ray_y);
  prediction.across_share = -line.normal.dot(ray);
  if (prediction.across_share < kMinSine) return prediction;
  if (point.bearing_rad - before.bearing_rad > kMaxGap_rad) return prediction;

  const double range_m = line.offset_m / -prediction.across_share;
  const Vec2 direction = line.direction();
  prediction.along_share = direction.dot(ray);
  prediction.residual_m = point.range_m - range_m;
  const double along_m = direction.dot(range_m * ray - line.centroid);
  const double step_m =
      range_m * prediction.along_share - direction.dot(Vec2(before.x_m, before.y_m));

  const double scale = noise_scale();
  prediction.variance_m2 =
      noise_.variance_across_m2(range_m, prediction.across_share) + line.variance_at(along_m);
  const double limit_m = config_.sigma_offset * range_m;
  const double noise_along_m = noise_.sigma_range_m(range_m) * std::abs(prediction.along_share);
  prediction.minor_m = std::min(kGateSigmas * scale * std::sqrt(prediction.variance_m2), limit_m);
  prediction.major_m = std::abs(step_m) + 2 * kGateSigmas * scale * noise_along_m;
  prediction.valid = prediction.major_m > 0 && prediction.minor_m > 0;
  return prediction;
}

bool Altbd::start(const PolarScan& scan, std::size_t index) {
  current_ = SegmentTrack::starting_at(scan, index);
  for (std::size_t i = index; i < index + kSeedSize; ++i) current_.add(scan, i, noise_);
  current_.line = current_.fit.line();

  // A seed across the step from a near wall to a far one is a line along the rays.
  const PolarPoint& middle = scan[index + kSeedSize / 2];
  const double sine = -current_.line.normal.dot(Vec2(middle.ray_x, middle.ray_y));
  if (sine < kMinSine) return false;
  if (scan[current_.last].bearing_rad - scan[index].bearing_rad > kMaxGap_rad) return false;
  // The weights know the noise along the rays; what counts here is the noise across the line.
  const double sigma_m = noise_.sigma_range_m(middle.range_m);
  const double variance = noise_.variance_across_m2(middle.range_m, sine);
  const double chi_square = current_.fit.chi_square() * sigma_m * sigma_m / variance;
  const double limit = kGateSigmas * noise_scale();
  return chi_square < limit * limit;
}

void Altbd::extend(const PolarScan& scan, std::size_t index) {
  current_.add(scan, index, noise_);
  current_.line = current_.fit.line();
}

void Altbd::learn_noise(double z_square) {
  residual_sum_ += z_square;
  residual_count_ += 1;
}

std::size_t Altbd::track(const PolarScan& scan, SegmentTracks& tracks) {
  tracks.clear();
  residual_sum_ = 0;
  residual_count_ = 0;
  std::size_t dropped = 0;
  std::size_t index = 0;
  while (index + kSeedSize <= scan.size()) {
    if (!start(scan, index)) {
      ++index;
      continue;
    }
    std::uint32_t misses = 0;
    for (std::size_t next = index + kSeedSize; next < scan.size(); ++next) {
      const Prediction prediction = predict(scan, next);
      if (prediction.valid && prediction.inside_ellipse()) {
        const double across_m = prediction.residual_m * prediction.across_share;
        learn_noise(across_m * across_m / prediction.variance_m2);
        extend(scan, next);
        misses = 0;
      } else {
        if (++misses == kMissesToBreak) break;
      }
    }
    const bool wall = current_.support >= kMinSupport;
    if (!keep_wall(current_, tracks)) ++dropped;
    // What is no wall gives back all but its first sample: another line may start within it.
    index = wall ? current_.last + 1U : index + 1;
  }
  return dropped;
}

}  // namespace cornerd::core
