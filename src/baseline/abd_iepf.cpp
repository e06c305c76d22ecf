// SPDX-License-Identifier: MIT
#include "baseline/abd_iepf.hpp"

#include <algorithm>
#include <cmath>

namespace cornerd::baseline {
namespace {

/// In a closed room both ends of a segment can coincide. A chord below an A1's resolution has no
/// usable direction, so the distance from its end is used.
constexpr double kMinChord_m = 0.001;

/// Constants of eq. 4 and 5, computed once a scan.
struct Abd {
  explicit Abd(const AbdIepfConfig& config)
      : threshold(config.threshold),
        lambda_rad(config.lambda_rad),
        sin_lambda(std::sin(config.lambda_rad)),
        cos_lambda(std::cos(config.lambda_rad)),
        sigma3(3 * config.sigma_r) {}

  double limit_m(const core::PolarPoint& before, const core::PolarPoint& after) const {
    if (after.bearing_rad - before.bearing_rad >= lambda_rad) return 0;
    const double sine = before.ray_x * after.ray_y - before.ray_y * after.ray_x;
    const double cosine = before.ray_x * after.ray_x + before.ray_y * after.ray_y;
    const double ratio = sine / (sin_lambda * cosine - cos_lambda * sine);
    if (threshold == AbdThreshold::kBorgesAldon) return before.range_m * ratio + sigma3;
    const auto [shorter_m, longer_m] = std::minmax(before.range_m, after.range_m);
    return shorter_m * (1 - sigma3) * ratio + sigma3 * longer_m;
  }

  /// Eq. 1.
  bool are_apart(const core::PolarPoint& before, const core::PolarPoint& after) const {
    const double limit = limit_m(before, after);
    return (after.position() - before.position()).squaredNorm() > limit * limit;
  }

  AbdThreshold threshold;
  double lambda_rad;
  double sin_lambda;
  double cos_lambda;
  double sigma3;
};

struct Farthest {
  std::size_t index = 0;
  double height_m2 = 0;  ///< squared
};

/// Of the samples between the ends, without them.
Farthest farthest_from_chord(const core::PolarScan& scan, std::size_t first, std::size_t last) {
  const core::Vec2 begin = scan[first].position();
  const core::Vec2 chord = scan[last].position() - begin;
  const double length_m = chord.norm();
  const bool closed = length_m <= kMinChord_m;
  const core::Vec2 direction = closed ? core::Vec2::Zero() : core::Vec2(chord / length_m);
  Farthest farthest;
  for (std::size_t i = first + 1; i < last; ++i) {
    const core::Vec2 offset = scan[i].position() - begin;
    const double height_m = core::cross(direction, offset);
    const double height_m2 = closed ? offset.squaredNorm() : height_m * height_m;
    if (height_m2 > farthest.height_m2) farthest = {i, height_m2};
  }
  return farthest;
}

}  // namespace

double abd_threshold_m(const AbdIepfConfig& config, const core::PolarPoint& before,
                       const core::PolarPoint& after) {
  return Abd(config).limit_m(before, after);
}

AbdIepf::AbdIepf(const core::DetectorConfig& detector, const core::SensorNoise& noise,
                 const AbdIepfConfig& config)
    : noise_(noise), config_(config), min_support_(detector.min_support) {
  ends_.reserve(core::kMaxSamplesPerScan);  // distinct samples of one scan
}

core::SegmentTrack AbdIepf::fit(const core::PolarScan& scan, std::size_t first,
                                std::size_t last) const {
  core::SegmentTrack piece = core::SegmentTrack::starting_at(scan, first);
  for (std::size_t i = first; i <= last; ++i) piece.add(scan, i, noise_);
  piece.line = piece.fit.line();
  return piece;
}

std::size_t AbdIepf::split(const core::PolarScan& scan, std::size_t first, std::size_t last,
                           core::SegmentTracks& tracks) {
  const double limit_m2 = config_.split_limit_m * config_.split_limit_m;
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
    const std::size_t own = begin == first ? first : begin + 1;
    if (end + 1 >= own + min_support_ && !keep_wall(fit(scan, own, end), tracks)) ++dropped;
    begin = end;
    ends_.pop_back();
  }
  return dropped;
}

std::size_t AbdIepf::track(const core::PolarScan& scan, core::SegmentTracks& tracks) {
  tracks.clear();
  const Abd abd(config_);
  std::size_t dropped = 0;
  std::size_t first = 0;
  for (std::size_t next = 1; next <= scan.size(); ++next) {
    const bool ends = next == scan.size() || abd.are_apart(scan[next - 1], scan[next]);
    if (!ends) continue;
    dropped += split(scan, first, next - 1, tracks);
    first = next;
  }
  return dropped;
}

}  // namespace cornerd::baseline
