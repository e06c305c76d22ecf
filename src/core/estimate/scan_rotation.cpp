// SPDX-License-Identifier: MIT
#include "core/estimate/scan_rotation.hpp"

#include <algorithm>
#include <cmath>

#include "core/geometry/angle.hpp"

namespace cornerd::core {
namespace {

/// A robot's fastest turn.
constexpr double kMaxRate_rad_s = 4;
constexpr double kMaxInterval_s = 1;
/// Ranges of one surface, seen from two places of a robot in motion, differ by up to this share.
constexpr float kSameShare = 0.1F;
/// Two scans that look alike agree in more of the bearings than this.
constexpr double kMinAgreement = 0.5;

}  // namespace

void ScanRotation::add(const Scan& turn) {
  rate_rad_s_.reset();
  before_ = last_;
  last_ = {{}, turn.start_ns()};
  for (const Sample& sample : turn.samples()) {
    const double bin = std::floor(sample.bearing_rad / kTwoPi * kBins) + kBins;
    float& nearest_m = last_.ranges_m[static_cast<std::size_t>(bin) % kBins];
    if (sample.range_m > 0 && (nearest_m == 0 || sample.range_m < nearest_m)) {
      nearest_m = sample.range_m;
    }
  }
  scans_ = turn.empty() ? 0 : std::min(scans_ + 1, 2);
}

std::optional<double> ScanRotation::rate_rad_s() const {
  if (!rate_rad_s_) rate_rad_s_ = find_rate_rad_s();
  return *rate_rad_s_;
}

std::optional<double> ScanRotation::find_rate_rad_s() const {
  const double interval_s = to_seconds(last_.start_ns - before_.start_ns);
  if (scans_ < 2 || interval_s <= 0 || interval_s > kMaxInterval_s) return std::nullopt;

  // A lidar that turns counter-clockwise sees a wall at lower bearings than before.
  const auto agreement = [&](int shift) {
    int same = 0;
    int both = 1;
    const auto first = static_cast<std::size_t>(shift + static_cast<int>(kBins)) % kBins;
    for (std::size_t i = 0, at = first; i < kBins; ++i, at = at + 1 < kBins ? at + 1 : 0) {
      if (last_.ranges_m[i] == 0 || before_.ranges_m[at] == 0) continue;
      ++both;
      same += std::abs(last_.ranges_m[i] - before_.ranges_m[at]) < kSameShare * last_.ranges_m[i]
                  ? 1
                  : 0;
    }
    return static_cast<double>(same) / both;
  };
  constexpr double kBin_rad = kTwoPi / kBins;
  const int most =
      static_cast<int>(std::min(kBins / 2.0, std::ceil(kMaxRate_rad_s * interval_s / kBin_rad)));
  int best_shift = 0;
  double best = agreement(0);
  for (int shift = -most; shift <= most; ++shift) {
    const double share = agreement(shift);
    if (share > best) {
      best = share;
      best_shift = shift;
    }
  }
  if (best < kMinAgreement) return std::nullopt;
  // The peak's vertex.
  const double below = agreement(best_shift - 1);
  const double above = agreement(best_shift + 1);
  const double curvature = below + above - 2 * best;
  const double offset = curvature < 0 ? (below - above) / curvature / 2 : 0;
  return (best_shift + offset) * kBin_rad / interval_s;
}

}  // namespace cornerd::core
