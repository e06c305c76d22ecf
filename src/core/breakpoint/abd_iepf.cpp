// SPDX-License-Identifier: MIT
#include "core/breakpoint/abd_iepf.hpp"

#include <algorithm>
#include <cmath>

namespace cornerd::core {
namespace {

/// Section V.C, both.
constexpr double kSigma = 0.0038;
constexpr double kLambda_rad = radians(8);

/// Round a closed room a segment's ends can be one place. Below an A1's resolution a chord has no
/// direction to speak of, and the distance to that place counts instead.
constexpr double kMinChord_m = 0.001;

const double kSinLambda = std::sin(kLambda_rad);
const double kCosLambda = std::cos(kLambda_rad);

Vec2 place_of(const PolarPoint& point) { return {point.x_m, point.y_m}; }

/// Eq. 1.
bool are_apart(AbdThreshold threshold, const PolarPoint& before, const PolarPoint& after) {
  const double limit_m = abd_threshold_m(threshold, before, after);
  return (place_of(after) - place_of(before)).squaredNorm() > limit_m * limit_m;
}

struct Farthest {
  std::size_t index = 0;
  double height_m2 = 0;  ///< squared
};

/// Of the samples strictly between the ends.
Farthest farthest_from_chord(const PolarScan& scan, std::size_t first, std::size_t last) {
  const Vec2 begin = place_of(scan[first]);
  const Vec2 chord = place_of(scan[last]) - begin;
  const double length_m = chord.norm();
  const Vec2 direction = length_m > kMinChord_m ? Vec2(chord / length_m) : Vec2::Zero();
  Farthest farthest;
  for (std::size_t i = first + 1; i < last; ++i) {
    const Vec2 offset = place_of(scan[i]) - begin;
    const double along_m = direction.dot(offset);
    const double height_m2 = offset.squaredNorm() - along_m * along_m;
    if (height_m2 > farthest.height_m2) farthest = {i, height_m2};
  }
  return farthest;
}

}  // namespace

double abd_threshold_m(AbdThreshold threshold, const PolarPoint& before, const PolarPoint& after) {
  if (after.bearing_rad - before.bearing_rad >= kLambda_rad) return 0;
  const Vec2 ray(before.ray_x, before.ray_y);
  const Vec2 next_ray(after.ray_x, after.ray_y);
  const double sine = cross(ray, next_ray);
  const double ratio = sine / (kSinLambda * ray.dot(next_ray) - kCosLambda * sine);
  if (threshold == AbdThreshold::kBorgesAldon) return before.range_m * ratio + 3 * kSigma;
  const auto [shorter_m, longer_m] = std::minmax(before.range_m, after.range_m);
  return shorter_m * (1 - 3 * kSigma) * ratio + 3 * kSigma * longer_m;
}

AbdIepf::AbdIepf(const SensorNoise& noise, const AbdIepfOptions& options)
    : noise_(noise), options_(options) {
  ends_.reserve(kMaxSamplesPerTurn);  // they are different samples: no turn has more of them
}

SegmentTrack AbdIepf::fit(const PolarScan& scan, std::size_t first, std::size_t last) const {
  SegmentTrack piece = SegmentTrack::starting_at(scan, first);
  for (std::size_t i = first; i <= last; ++i) piece.add(scan, i, noise_);
  piece.line = piece.fit.line();
  return piece;
}

std::size_t AbdIepf::split(const PolarScan& scan, std::size_t first, std::size_t last,
                           SegmentTracks& tracks) {
  const double limit_m2 = options_.split_limit_m * options_.split_limit_m;
  std::size_t dropped = 0;
  std::size_t begin = first;
  ends_.assign(1, last);
  while (!ends_.empty()) {
    const std::size_t end = ends_.back();
    const Farthest farthest = farthest_from_chord(scan, begin, end);
    if (farthest.height_m2 > limit_m2) {
      ends_.push_back(farthest.index);
      continue;
    }
    if (!keep_wall(fit(scan, begin == first ? first : begin + 1, end), tracks)) ++dropped;
    begin = end;
    ends_.pop_back();
  }
  return dropped;
}

std::size_t AbdIepf::track(const PolarScan& scan, SegmentTracks& tracks) {
  tracks.clear();
  std::size_t dropped = 0;
  std::size_t first = 0;
  for (std::size_t next = 1; next <= scan.size(); ++next) {
    const bool ends =
        next == scan.size() || are_apart(options_.threshold, scan[next - 1], scan[next]);
    if (!ends) continue;
    dropped += split(scan, first, next - 1, tracks);
    first = next;
  }
  return dropped;
}

}  // namespace cornerd::core
