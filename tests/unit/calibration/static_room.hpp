// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <random>

#include "calibration/bearing_bins.hpp"

namespace cornerd::calibration {

/// A stationary lidar in a rectangle of 9 x 6 m, 0.4 m from one wall and 2 m from another.
struct StaticRoom {
  int scans = 60;
  int samples_per_scan = 300;
  std::function<double(double)> sigma_m = [](double) { return 0.0; };  ///< by the range
  double bearing_rad = 0;
  double outliers = 0;

  BearingBins record(unsigned seed = 1) const;
  static double true_range_m(double bearing_rad);
};

}  // namespace cornerd::calibration
