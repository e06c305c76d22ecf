// SPDX-License-Identifier: MIT
#include "core/breakpoint/altbd.hpp"

#include <algorithm>
#include <cmath>

#include "core/breakpoint/wall_tests.hpp"

namespace cornerd::core {
namespace {

/// A ray closer to the wall's direction than this tells nothing of where it meets the wall.
constexpr double kMinSine = 0.03;
/// Three samples closer to a ray than this are a step between two walls more often than one.
constexpr double kMinSeedSine = 0.06;
/// A line is fitted anew when its wall has grown by a half, an older one when it has doubled: each
/// sample counts, and the ellipse knows the line's uncertainty in between.
constexpr std::uint32_t kYoung = 16;
constexpr std::uint32_t kYoungShare = 2;
/// Samples of a seed that needs no ellipses.
constexpr std::uint32_t kLongSeed = 8;
/// What the noise may be found to be, of the model's variance: ranges in whole millimetres are not
/// free of noise, and beyond ten times the model's sigma there are no walls.
constexpr double kMinVarianceScale = 0.1;
constexpr double kMaxVarianceScale = 100;
/// Samples that follow() gives one weight: their ranges differ little.
constexpr std::size_t kBlock = 32;
/// Share of the gate's square within which a sample is near: j^2 / minor^2 is below it, and
/// k^2 / major^2 below half of it. The rest is room for the ranges of a block.
constexpr double kNear = 0.6;

constexpr double square(double x) { return x * x; }

/// What a sample near a line is.
struct Near {
  Vec2 approach;     ///< the line's normal, away from the sensor
  double height_m;   ///< the line's distance from the sensor
  double max_gap_m;  ///< along the line
  double limit_m;    ///< across the line, for a ray that meets it squarely; less by the sine
};

/// Sums up the samples of a block up to the first that is not near. A function of its own: its
/// values then stay in registers.
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
  // The noise is the sensor's: where the last turn showed more than the model, this one begins with
  // it. Never with less: a turn without noise would leave a gate that no other turn passes.
  residual_sum_ =
      config_.prior_residuals * std::clamp(noise_variance_scale(), 1.0, kMaxVarianceScale);
  residual_count_ = config_.prior_residuals;
}

void Altbd::forget() { residual_sum_ = residual_count_ = config_.prior_residuals; }

double Altbd::noise_variance_scale() const {
  return std::clamp(residual_sum_ / residual_count_, kMinVarianceScale, kMaxVarianceScale);
}

double Altbd::noise_scale() const { return std::sqrt(noise_variance_scale()); }

/// Steps 1-4: a line through the first samples, of one weight since they are neighbours.
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

  // A seed across the step from a near wall to a far one is a line along the rays.
  const Vec2& normal = current_.line.normal;
  const double sine = -(normal.x() * middle.ray_x + normal.y() * middle.ray_y);
  if (sine < kMinSeedSine) return false;
  // The weights know the noise along the rays; what counts here is the noise across the line.
  const double variance = noise_.variance_across_m2(middle.range_m, sine);
  const double spare = samples - 2;
  return current_.fit.chi_square() * sigma2 / variance < gate2_ * std::sqrt(spare);
}

/// A long seed saves the ellipses of a young wall, where nothing is in doubt: no gap, no outlier.
bool Altbd::start_any(const PolarScan& scan, std::size_t index) {
  constexpr double kMaxSeed_m = 0.2;
  if (index + kLongSeed <= scan.size()) {
    const PolarPoint& first = scan[index];
    const PolarPoint& last = scan[index + kLongSeed - 1];
    const double extent2 = square(last.x_m - first.x_m) + square(last.y_m - first.y_m);
    if (extent2 < square(kMaxSeed_m) && start(scan, index, kLongSeed)) return true;
  }
  return start(scan, index, config_.seed_samples);
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
  const double j2 = j_m * j_m;
  const double limit2 = square(sigma_offset_ * range_m);
  if (j2 > limit2) return false;
  const Vec2 direction = line.direction();
  const double cosine = direction.x() * point.ray_x + direction.y() * point.ray_y;
  const double along_m = range_m * cosine;  // place of p' on the line, from the sensor's foot
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
  // k = j cos / sin: j^2 / minor^2 + k^2 / major^2 <= 1, without its fractions.
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
  const std::uint32_t share = current_.support < kYoung ? kYoungShare : 1;
  refit_at_ = current_.support + std::max<std::uint32_t>(1, current_.support / share);
  gate2_ = square(config_.gate_sigmas) * noise_variance_scale();
}

/// Samples that follow() looks at: a block, or what is left to the next refit.
std::size_t Altbd::to_follow() const {
  return std::min<std::size_t>(kBlock, refit_at_ - current_.support);
}

/// The next samples of a block that are so near to the line that they are inside the
/// ellipse whatever its exact size. Returns how many there are. Most samples of a turn go this way,
/// in a third of the instructions of is_hit().
std::size_t Altbd::follow(const PolarScan& scan) {
  const std::size_t begin = next_;
  std::size_t block_end = std::min(scan.size(), begin + to_follow());
  const Line& line = current_.line;
  Near near{-line.normal, -line.offset_m, config_.max_gap_m, 0};
  // The wall goes away from its centroid: its uncertainty here is the least of what is to come.
  const PolarPoint& last = scan[current_.last];
  const double along_m = (last.place() - line.centroid).norm();
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

/// What the wall's samples tell of the noise: their distances to the line, less what the line took.
void Altbd::learn_noise() {
  constexpr std::uint32_t kTellingSamples = 8;
  if (current_.support < kTellingSamples) return;
  residual_sum_ += current_.fit.chi_square() * across_factor(noise_, current_.line);
  residual_count_ += current_.support - 2;
}

/// A sample of what is behind that lies on the wall's line by chance, after the wall's end.
void Altbd::give_back_lone_hit(const PolarScan& scan) {
  if (hits_ != 1) return;
  current_.take_back(scan, current_.last, noise_);
  current_.last = before_misses_;
}

bool Altbd::announces(SegmentTrack& wall) {
  if (begun_ || is_doubtful(current_, extraction_, noise_scale())) return false;
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
      if (!start_any(scan, index_)) {
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
        // Whole blocks alone, so that the walls are the same however the returns come.
        if (!ended && next_ + to_follow() > scan.size()) return Event::kNone;
        const std::size_t followed = follow(scan);
        hits_ += static_cast<std::uint32_t>(followed);
        if (followed > 0 && announces(wall)) return Event::kWallBegun;
        if (followed > 0) continue;
      }
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
      if (announces(wall)) return Event::kWallBegun;
    }
    if (misses_ < config_.misses_to_break && !ended) return Event::kNone;

    tracking_ = false;
    give_back_lone_hit(scan);
    const bool is_wall = current_.support >= min_support_;
    // What is no wall gives back all but its first sample: another line may start within it.
    index_ = is_wall ? current_.last + 1U : index_ + 1;
    if (!is_wall) continue;
    current_.line = current_.fit.line();
    learn_noise();
    wall = current_;
    return begun_ ? Event::kWallEnded : Event::kShortWall;
  }
}

}  // namespace cornerd::core
