// SPDX-License-Identifier: MIT
#include "core/breakpoint/altbd.hpp"

#include <algorithm>
#include <cmath>

namespace cornerd::core {
namespace {

/// A ray closer to the wall's direction than this tells nothing of where it meets the wall.
constexpr double kMinSine = 0.03;
/// Three samples closer to a ray than this are a step between two walls more often than one.
constexpr double kMinSeedSine = 0.06;
/// A line of more samples than this is fitted anew only when it has grown by an eighth: each sample
/// still counts, and the line moves by less than its own uncertainty in between.
constexpr std::uint32_t kAlwaysRefit = 8;

constexpr double square(double x) { return x * x; }

}  // namespace

Altbd::Altbd(const DetectorConfig& config, const SensorNoise& noise)
    : config_(config.altbd),
      sigma_offset_(config.sigma_offset),
      min_support_(config.min_support),
      noise_(noise),
      residual_sum_(config_.prior_residuals),
      residual_count_(config_.prior_residuals) {}

void Altbd::begin() {
  tracking_ = false;
  begun_ = false;
  index_ = 0;
  // The noise is the sensor's: what the last turn showed is where this one begins.
  residual_sum_ = config_.prior_residuals * noise_variance_scale();
  residual_count_ = config_.prior_residuals;
}

double Altbd::noise_variance_scale() const {
  return residual_sum_ / residual_count_;
}

double Altbd::noise_scale() const { return std::sqrt(noise_variance_scale()); }

/// Steps 1-4: a line through the first samples.
bool Altbd::start(const PolarScan& scan, std::size_t index) {
  const std::size_t end = index + config_.seed_samples;
  current_ = SegmentTrack::starting_at(scan, index);
  for (std::size_t i = index; i < end; ++i) current_.add(scan, i, noise_);
  current_.line = current_.fit.line();
  refit_at_ = 0;

  // A seed across the step from a near wall to a far one is a line along the rays.
  const PolarPoint& middle = scan[index + config_.seed_samples / 2];
  const double sine = -current_.line.normal.dot(Vec2(middle.ray_x, middle.ray_y));
  if (sine < kMinSeedSine) return false;
  if (scan[current_.last].bearing_rad - scan[index].bearing_rad > config_.max_gap_rad) return false;
  // The weights know the noise along the rays; what counts here is the noise across the line.
  const double variance = noise_.variance_across_m2(middle.range_m, sine);
  const double chi_square =
      current_.fit.chi_square() * square(noise_.sigma_range_m(middle.range_m)) / variance;
  return chi_square < square(config_.gate_sigmas) * noise_variance_scale();
}

/// Steps 6-12. The next ray meets the line at the predicted point p'; the sample misses it by
/// `k_m` along the line and `j_m` across it. No root is taken: axes and residuals are compared
/// squared, and the ellipse's equation is multiplied by both axes.
bool Altbd::is_hit(const PolarScan& scan, std::size_t index) {
  const PolarPoint& point = scan[index];
  const PolarPoint& before = scan[current_.last];
  const Line& line = current_.line;
  const double sine = -(line.normal.x() * point.ray_x + line.normal.y() * point.ray_y);
  if (sine < kMinSine) return false;
  if (point.bearing_rad - before.bearing_rad > config_.max_gap_rad) return false;

  const double j_m = line.normal.x() * point.x_m + line.normal.y() * point.y_m - line.offset_m;
  const double range_m = point.range_m + j_m / sine;  // of p'
  const Vec2 direction = line.direction();
  const double cosine = direction.x() * point.ray_x + direction.y() * point.ray_y;
  const double along_m = range_m * cosine;  // place of p' on the line, from the sensor's foot
  const double to_centroid_m =
      along_m - direction.x() * line.centroid.x() - direction.y() * line.centroid.y();
  const double step_m = along_m - direction.x() * before.x_m - direction.y() * before.y_m;

  if (std::abs(step_m) > config_.max_gap_m) return false;

  const double gate2 = square(config_.gate_sigmas) * noise_variance_scale();
  const double sigma2 = square(noise_.sigma_range_m(range_m));
  const double aside2 = square(noise_.bearing_rad * range_m);
  const double variance =
      sigma2 * sine * sine + aside2 * cosine * cosine + line.variance_at(to_centroid_m);
  const double minor2 = std::min(gate2 * variance, square(sigma_offset_ * range_m));
  const double major2 = square(step_m) + 4 * gate2 * sigma2 * cosine * cosine;
  const double j2 = j_m * j_m;
  if (j2 > minor2) return false;
  // k = j cos / sin: j^2 / minor^2 + k^2 / major^2 <= 1, without its fractions.
  const double sine2 = sine * sine;
  if (j2 * (sine2 * major2 + cosine * cosine * minor2) > sine2 * minor2 * major2) return false;
  if (misses_ == 0) {
    residual_sum_ += j2 / variance;
    residual_count_ += 1;
  }
  return true;
}

/// Steps 16-18.
void Altbd::extend(const PolarScan& scan, std::size_t index) {
  current_.add(scan, index, noise_);
  if (current_.support < refit_at_) return;
  current_.line = current_.fit.line();
  refit_at_ =
      current_.support + (current_.support < kAlwaysRefit ? 1 : current_.support / kAlwaysRefit);
}

/// A sample of what is behind that lies on the wall's line by chance, after the wall's end.
void Altbd::give_back_lone_hit(const PolarScan& scan) {
  if (hits_ != 1) return;
  current_.take_back(scan, current_.last, noise_);
  current_.last = before_misses_;
}

Altbd::Event Altbd::next(const PolarScan& scan, bool ended, SegmentTrack& wall) {
  for (;;) {
    if (!tracking_) {
      if (index_ + config_.seed_samples > scan.size()) return Event::kNone;
      if (!start(scan, index_)) {
        ++index_;
        continue;
      }
      tracking_ = true;
      begun_ = false;
      next_ = index_ + config_.seed_samples;
      misses_ = 0;
      hits_ = config_.seed_samples;
    }
    while (next_ < scan.size() && misses_ < config_.misses_to_break) {
      if (!is_hit(scan, next_)) {
        ++misses_;
        ++next_;
        continue;
      }
      if (misses_ > 0) before_misses_ = current_.last;
      hits_ = misses_ > 0 ? 1 : hits_ + 1;
      extend(scan, next_);
      misses_ = 0;
      ++next_;
      if (begun_ || current_.support <= config_.doubtful_samples) continue;
      begun_ = true;
      wall = current_;
      return Event::kWallBegun;
    }
    if (misses_ < config_.misses_to_break && !ended) return Event::kNone;

    tracking_ = false;
    give_back_lone_hit(scan);
    const bool is_wall = current_.support >= min_support_;
    // What is no wall gives back all but its first sample: another line may start within it.
    index_ = is_wall ? current_.last + 1U : index_ + 1;
    if (!is_wall) continue;
    current_.line = current_.fit.line();
    wall = current_;
    return begun_ ? Event::kWallEnded : Event::kShortWall;
  }
}

}  // namespace cornerd::core
