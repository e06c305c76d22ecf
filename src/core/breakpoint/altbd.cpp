// SPDX-License-Identifier: MIT
#include "core/breakpoint/altbd.hpp"

#include <algorithm>
#include <cmath>

#include "core/breakpoint/wall_tests.hpp"

namespace cornerd::core {
namespace {

/// A ray closer to the wall's direction has no usable intersection with it.
constexpr double kMinSine = 0.03;
/// Three samples closer to a ray's direction are a step between two walls more often than one wall.
constexpr double kMinSeedSine = 0.06;
/// A line is refitted when its wall has grown by a half, a longer one when it has doubled; in
/// between the ellipse contains the line's uncertainty.
constexpr std::uint32_t kShortWall = 16;
constexpr std::uint32_t kShortWallShare = 2;
/// Samples of a seed that needs no ellipse tests.
constexpr std::uint32_t kLongSeed = 8;
/// Limits of the estimated noise variance over the model's: ranges are quantized to millimetres,
/// and beyond ten times the model's sigma there are no walls.
constexpr double kMinVarianceScale = 0.1;
constexpr double kMaxVarianceScale = 100;
/// Samples to which track_block() gives one weight: their ranges differ little.
constexpr std::size_t kBlock = 32;
/// Share of the squared gate that makes a sample near: j^2 / minor^2 is below it, and k^2 / major^2
/// below half of it. The rest is margin for the ranges within a block.
constexpr double kNear = 0.6;

constexpr double square(double x) { return x * x; }

/// Bounds of a sample near a line.
struct Near {
  Vec2 approach;     ///< the line's normal, away from the sensor
  double height_m;   ///< the line's distance from the sensor
  double max_gap_m;  ///< along the line
  double limit_m;    ///< across the line at normal incidence; scales with the sine of incidence
};

/// Sums over a block's samples up to the first that is not near. Not inlined, so that its values
/// stay in registers.
[[gnu::noinline]] const PolarPoint* sum_near(const PolarPoint* point, const PolarPoint* end,
                                             double bearing_rad, const Near& near,
                                             PointSums& result) {
  const Near n = near;
  PointSums sums;
  for (; point != end; ++point) {
    const double range_m = point->range_m;
    const double sine = n.approach.x() * point->ray_x + n.approach.y() * point->ray_y;
    const double step_rad = point->bearing_rad - bearing_rad;
    if (!(std::abs(range_m * sine - n.height_m) < n.limit_m * sine)) break;
    if (!(step_rad * range_m < n.max_gap_m * sine)) break;
    bearing_rad = point->bearing_rad;
    sums.add(point->x_m, point->y_m);
  }
  result = sums;
  return point;
}

}  // namespace

Altbd::Altbd(const DetectorConfig& config, const SensorNoise& noise)
    : config_(config.altbd),
      extraction_(config.extraction),
      sigma_offset_(config.sigma_offset),
      min_support_(config.min_support),
      noise_(noise),
      residual_sum_(config_.prior_residuals),
      residual_count_(config_.prior_residuals) {}

void Altbd::begin() {
  tracking_ = false;
  begun_ = false;
  index_ = 0;
  // The noise belongs to the sensor: an estimate above the model carries over to the next scan. One
  // below does not: a noiseless scan would leave a gate that no other scan passes.
  residual_sum_ =
      config_.prior_residuals * std::clamp(noise_variance_scale(), 1.0, kMaxVarianceScale);
  residual_count_ = config_.prior_residuals;
}

void Altbd::forget() { residual_sum_ = residual_count_ = config_.prior_residuals; }

double Altbd::noise_variance_scale() const {
  return std::clamp(residual_sum_ / residual_count_, kMinVarianceScale, kMaxVarianceScale);
}

double Altbd::noise_scale() const { return std::sqrt(noise_variance_scale()); }

/// Steps 1-4: a line through the first samples, with one weight since they are neighbours.
bool Altbd::start(const PolarScan& scan, std::size_t index, std::uint32_t samples) {
  if (index + samples > scan.size()) return false;
  const PolarPoint& first = scan[index];
  const PolarPoint& last = scan[index + samples - 1];
  if (last.bearing_rad - first.bearing_rad > config_.max_gap_rad) return false;
  const PolarPoint& middle = scan[index + samples / 2];
  const double sigma2 = square(noise_.sigma_range_m(middle.range_m));
  PointSums sums;
  for (std::size_t i = index; i < index + samples; ++i) sums.add(scan[i].x_m, scan[i].y_m);
  current_ = SegmentTrack::starting_at(scan, index);
  current_.fit.add(sums, static_cast<int>(samples), 1 / sigma2);
  current_.last = static_cast<std::uint32_t>(index + samples - 1);
  current_.support = samples;
  refit();

  // A seed across the step from a near wall to a far one runs along the rays.
  const Vec2& normal = current_.line.normal;
  const double sine = -(normal.x() * middle.ray_x + normal.y() * middle.ray_y);
  if (sine < kMinSeedSine) return false;
  // The weights contain the noise along the rays; the test needs the noise across the line.
  const double variance = noise_.variance_across_m2(middle.range_m, sine);
  const double spare = samples - 2;
  return current_.fit.chi_square() * sigma2 / variance < gate2_ * std::sqrt(spare);
}

/// A long seed without gap or outlier saves the ellipse tests of a short wall.
bool Altbd::start_wall(const PolarScan& scan, std::size_t index) {
  constexpr double kMaxSeed_m = 0.2;
  if (index + kLongSeed <= scan.size()) {
    const PolarPoint& first = scan[index];
    const PolarPoint& last = scan[index + kLongSeed - 1];
    const double extent2 = square(last.x_m - first.x_m) + square(last.y_m - first.y_m);
    if (extent2 < square(kMaxSeed_m) && start(scan, index, kLongSeed)) return true;
  }
  return start(scan, index, config_.seed_samples);
}

/// Steps 6-12. The next ray meets the line at the predicted point p'; the sample misses p' by k
/// along the line and j across it. Axes and residuals are compared squared and the ellipse's
/// equation is multiplied by both axes, so that no root is needed.
bool Altbd::is_hit(const PolarScan& scan, std::size_t index) {
  const PolarPoint& point = scan[index];
  const PolarPoint& before = scan[current_.last];
  const Line& line = current_.line;
  const double sine = -(line.normal.x() * point.ray_x + line.normal.y() * point.ray_y);
  if (sine < kMinSine) return false;
  if (point.bearing_rad - before.bearing_rad > config_.max_gap_rad) return false;

  const double j_m = line.normal.x() * point.x_m + line.normal.y() * point.y_m - line.offset_m;
  const double range_m = point.range_m + j_m / sine;  // of p'
  const double j2 = j_m * j_m;
  const double limit2 = square(sigma_offset_ * range_m);
  if (j2 > limit2) return false;
  const Vec2 direction = line.direction();
  const double cosine = direction.x() * point.ray_x + direction.y() * point.ray_y;
  const double along_m = range_m * cosine;  // position of p' on the line, from the sensor's foot
  const double to_centroid_m =
      along_m - direction.x() * line.centroid.x() - direction.y() * line.centroid.y();
  const double step_m = along_m - direction.x() * before.x_m - direction.y() * before.y_m;
  if (std::abs(step_m) > config_.max_gap_m) return false;

  const double sigma2 = square(noise_.sigma_range_m(range_m));
  const double aside2 = square(noise_.bearing_rad * range_m);
  const double variance =
      sigma2 * sine * sine + aside2 * cosine * cosine + line.variance_at(to_centroid_m);
  const double minor2 = std::min(gate2_ * variance, limit2);
  const double major2 = square(step_m) + 4 * gate2_ * sigma2 * cosine * cosine;
  if (j2 > minor2) return false;
  // k = j cos / sin: j^2 / minor^2 + k^2 / major^2 <= 1, without fractions.
  const double sine2 = sine * sine;
  return j2 * (sine2 * major2 + cosine * cosine * minor2) <= sine2 * minor2 * major2;
}

/// Steps 16-18.
void Altbd::extend(const PolarScan& scan, std::size_t index) {
  current_.add(scan, index, noise_);
  if (current_.support >= refit_at_) refit();
}

void Altbd::refit() {
  current_.line = current_.fit.line();
  const std::uint32_t share = current_.support < kShortWall ? kShortWallShare : 1;
  refit_at_ = current_.support + std::max<std::uint32_t>(1, current_.support / share);
  gate2_ = square(config_.gate_sigmas) * noise_variance_scale();
}

/// A block, or the samples up to the next refit.
std::size_t Altbd::block_size() const {
  return std::min<std::size_t>(kBlock, refit_at_ - current_.support);
}

/// Adds the next samples of a block that are inside the ellipse whatever its exact size. Returns
/// their number. Most samples take this path, at a third of the instructions of is_hit().
std::size_t Altbd::track_block(const PolarScan& scan) {
  const std::size_t begin = next_;
  std::size_t block_end = std::min(scan.size(), begin + block_size());
  const Line& line = current_.line;
  Near near{-line.normal, -line.offset_m, config_.max_gap_m, 0};
  // The wall extends away from its centroid: the line's uncertainty here is a lower bound.
  const PolarPoint& last = scan[current_.last];
  const double along_m = (last.position() - line.centroid).norm();
  const double variance_line = line.variance_at(along_m);
  const double bearing_rad = last.bearing_rad;
  if (scan[block_end - 1].bearing_rad - bearing_rad > config_.max_gap_rad) {
    block_end = next_ + 1;
    if (scan[next_].bearing_rad - bearing_rad > config_.max_gap_rad) return 0;
  }
  const double range_m = scan[next_].range_m;
  const double variance = square(noise_.sigma_range_m(range_m));
  const double gate2 =
      std::min(gate2_ * (variance + variance_line), square(sigma_offset_ * range_m));
  near.limit_m = std::sqrt(kNear * gate2);
  PointSums sums;
  const PolarPoint* const first = &scan[begin];
  const PolarPoint* const end = sum_near(first, &scan[0] + block_end, bearing_rad, near, sums);
  const auto count = static_cast<std::uint32_t>(end - first);
  if (count == 0) return 0;
  current_.fit.add(sums, static_cast<int>(count), 1 / variance);
  next_ += count;
  current_.last = static_cast<std::uint32_t>(next_ - 1);
  current_.support += count;
  if (current_.support >= refit_at_) refit();
  return count;
}

/// The wall's residuals estimate the noise, with the line's two degrees of freedom removed.
void Altbd::update_noise() {
  constexpr std::uint32_t kMinSamples = 8;
  if (current_.support < kMinSamples) return;
  residual_sum_ += current_.fit.chi_square() * across_factor(noise_, current_.line);
  residual_count_ += current_.support - 2;
}

/// A single sample of the background that lies on the wall's line beyond the wall's end.
void Altbd::return_isolated_hit(const PolarScan& scan) {
  if (hits_ != 1) return;
  current_.remove(scan, current_.last, noise_);
  current_.last = last_before_misses_;
}

bool Altbd::reports_begin(SegmentTrack& wall) {
  if (begun_ || is_short(current_, extraction_, noise_scale())) return false;
  begun_ = true;
  wall = current_;
  return true;
}

Altbd::Event Altbd::next(const PolarScan& scan, bool ended, SegmentTrack& wall) {
  for (;;) {
    if (!tracking_) {
      if (index_ + (ended ? config_.seed_samples : std::max(kLongSeed, config_.seed_samples)) >
          scan.size()) {
        return Event::kNone;
      }
      if (!start_wall(scan, index_)) {
        ++index_;
        continue;
      }
      tracking_ = true;
      begun_ = false;
      next_ = current_.last + 1U;
      misses_ = 0;
      hits_ = current_.support;
    }
    while (next_ < scan.size() && misses_ < config_.misses_to_break) {
      if (misses_ == 0) {
        // Only whole blocks, so that the walls do not depend on how the returns arrive.
        if (!ended && next_ + block_size() > scan.size()) return Event::kNone;
        const std::size_t followed = track_block(scan);
        hits_ += static_cast<std::uint32_t>(followed);
        if (followed > 0 && reports_begin(wall)) return Event::kWallBegun;
        if (followed > 0) continue;
      }
      if (!is_hit(scan, next_)) {
        ++misses_;
        ++next_;
        continue;
      }
      if (misses_ > 0) last_before_misses_ = current_.last;
      hits_ = misses_ > 0 ? 1 : hits_ + 1;
      extend(scan, next_);
      misses_ = 0;
      ++next_;
      if (reports_begin(wall)) return Event::kWallBegun;
    }
    if (misses_ < config_.misses_to_break && !ended) return Event::kNone;

    tracking_ = false;
    return_isolated_hit(scan);
    const bool is_wall = current_.support >= min_support_;
    // A track too short for a wall returns all but its first sample: another line may start in it.
    index_ = is_wall ? current_.last + 1U : index_ + 1;
    if (!is_wall) continue;
    current_.line = current_.fit.line();
    update_noise();
    wall = current_;
    return begun_ ? Event::kWallEnded : Event::kShortWall;
  }
}

}  // namespace cornerd::core
