// SPDX-License-Identifier: MIT
// The plain noise model: sigma as a function of range, and the bearing's share in it.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "calibration/bearing_bins.hpp"
#include "core/sensor_noise.hpp"

namespace cornerd::calibration {

/// What was measured between two ranges.
struct RangeCell {
  double from_m = 0;
  double to_m = 0;
  double range_m = 0;  ///< median of the bins in it
  double sigma_m = 0;  ///< of the range alone: median of the bins, the bearing's part taken out
  double low_m = 0;    ///< quarter of the bins with less
  double high_m = 0;   ///< quarter with more
  /// Median of all bins, those that meet their wall at a slant among them.
  double sigma_all_m = 0;
  std::size_t bins = 0;  ///< that tell sigma_m
};

struct RangeNoise {
  core::SensorNoise plain;        ///< floor, share and bearing; no table
  std::vector<RangeCell> cells;   ///< those in which enough was measured
  bool bearing_measured = false;  ///< else plain.bearing_rad is the default
  /// Mean departure of the cells' sigmas from floor and share, as a factor less 1.
  double plain_residual = 0;

  /// False where what returned can be no wall: a lidar is not off by a tenth of the range.
  bool is_of_walls() const;

  /// The cells as a table, of which a sensor's noise may be made.
  std::vector<core::SigmaTable::Point> table() const;
};

/// nullopt where no range has enough bins.
///
/// A ray that meets its wall at a slant feels the noise of the bearing in its range: sigma^2 =
/// sigma_range^2 + (slope * sigma_bearing)^2. Bins up to 30 degrees off the normal tell the range's
/// part, steeper ones the bearing's.
std::optional<RangeNoise> fit_range_noise(std::span<const BinSpread> bins);

}  // namespace cornerd::calibration
