// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace cornerd::calibration {

/// A return of a lidar that does not move.
struct Return {
  float bearing_rad = 0;
  float range_m = 0;
};

/// What one direction saw of a wall, turn after turn.
struct BinSpread {
  double bearing_rad = 0;  ///< mean
  double range_m = 0;      ///< at that bearing
  double sigma_m = 0;      ///< of the range about a straight line over the bearing
  double slope_m = 0;      ///< growth of the range with the bearing, per radian
  std::size_t returns = 0;
  /// Mean of the later half of the returns less that of the earlier one, in sigmas: 1.7 where the
  /// lidar moved evenly, near 0 where it stood.
  double drift = 0;
  double rejected = 0;  ///< share of the returns that lie off the line: edges, crosstalk, people

  /// Tangent of the angle between the ray and the wall's normal.
  double steepness() const { return range_m > 0 ? slope_m / range_m : 0; }
};

/// The returns of a static recording by their bearing.
class BearingBins {
 public:
  BearingBins();

  /// Empty samples (range 0) count for nothing. What exceeds the room of a bin is dropped.
  void add(double bearing_rad, double range_m);

  std::size_t returns() const { return returns_; }
  /// All that was kept, in the order of the bins.
  std::vector<Return> all() const;

  /// Bins with too few returns for a spread are left out. Where half a degree gathers too little,
  /// bins are wider: 1, 2 or 4 degrees, by which five turns are enough.
  std::vector<BinSpread> spreads() const;

 private:
  std::vector<BinSpread> spreads_of_width(std::size_t bins) const;

  std::vector<std::vector<Return>> bins_;
  std::size_t returns_ = 0;
};

}  // namespace cornerd::calibration
