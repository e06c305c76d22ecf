// SPDX-License-Identifier: MIT
#include "static_room.hpp"

#include <algorithm>
#include <cmath>

#include "core/geometry/angle.hpp"

namespace cornerd::calibration {

double StaticRoom::true_range_m(double bearing_rad) {
  const double x = std::cos(bearing_rad);
  const double y = std::sin(bearing_rad);
  const double along_x = x > 0 ? 7.0 / x : x < 0 ? -2.0 / x : 1e9;
  const double along_y = y > 0 ? 5.6 / y : y < 0 ? -0.4 / y : 1e9;
  return std::min(along_x, along_y);
}

BearingBins StaticRoom::record(unsigned seed) const {
  std::mt19937 engine(seed);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform;
  BearingBins bins;
  for (int i = 0; i < scans * samples_per_scan; ++i) {
    // Not a whole number of samples in a scan, as on real devices.
    const double claimed_rad = core::kTwoPi * i / (samples_per_scan + 0.37);
    const double range_m = true_range_m(claimed_rad + bearing_rad * normal(engine));
    const double noise_m = sigma_m(range_m) * normal(engine);
    bins.add(claimed_rad, uniform(engine) < outliers ? 6 * uniform(engine) : range_m + noise_m);
  }
  return bins;
}

}  // namespace cornerd::calibration
