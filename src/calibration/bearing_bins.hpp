// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace cornerd::calibration {

/// A return of a stationary lidar.
struct Return {
  float bearing_rad = 0;
  float range_m = 0;
};

/// Statistics of the returns in one bearing bin: a straight line of range over bearing.
struct BinSpread {
  double bearing_rad = 0;  ///< mean
  double range_m = 0;      ///< at that bearing
  double sigma_m = 0;      ///< of the range about the line
  double slope_m = 0;      ///< of the line, per radian
  std::size_t returns = 0;
  /// Mean of the later half of the returns less that of the earlier one, in sigmas: 1.7 where the
  /// lidar moved evenly, near 0 where it stood.
  double drift = 0;
  double rejected = 0;  ///< share of outliers: edges, crosstalk, people

  /// Tangent of the angle between the ray and the wall's normal.
  double steepness() const { return range_m > 0 ? slope_m / range_m : 0; }
};

/// The returns of a static recording by their bearing.
class BearingBins {
 public:
  BearingBins();

  /// Ignores empty samples (range 0), and returns beyond the capacity of a bin.
  void add(double bearing_rad, double range_m);

  std::size_t returns() const { return returns_; }
  /// All stored returns, sorted by bin.
  std::vector<Return> all() const;

  /// Bins with too few returns are left out. Bins of half a degree are widened to 1, 2 or 4 degrees
  /// where most have too few; five scans are then enough.
  std::vector<BinSpread> spreads() const;

 private:
  std::vector<BinSpread> spreads_of_width(std::size_t bins) const;

  std::vector<std::vector<Return>> bins_;
  std::size_t returns_ = 0;
};

}  // namespace cornerd::calibration
