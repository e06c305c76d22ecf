// SPDX-License-Identifier: MIT
// The plain noise model: range sigma as a function of range, and a bearing sigma.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "calibration/bearing_bins.hpp"
#include "core/sensor_noise.hpp"

namespace cornerd::calibration {

/// Statistics of the bins between two ranges.
struct RangeCell {
  double from_m = 0;
  double to_m = 0;
  double range_m = 0;      ///< median of the bins in it
  double sigma_m = 0;      ///< of the range alone: median of the bins without the bearing's part
  double low_m = 0;        ///< lower quartile
  double high_m = 0;       ///< upper quartile
  double sigma_all_m = 0;  ///< median of all bins, those at a slant included
  std::size_t bins = 0;    ///< used for sigma_m
};

struct RangeNoise {
  core::SensorNoise plain;        ///< floor, share and bearing; no table
  std::vector<RangeCell> cells;   ///< with enough bins
  bool bearing_measured = false;  ///< else plain.bearing_rad is the default
  /// Mean |log(sigma of the cell / model)|.
  double plain_residual = 0;

  /// False where a sigma exceeds a tenth of the range: the returns are not of walls.
  bool is_of_walls() const;

  /// The cells as a sigma table.
  std::vector<core::SigmaTable::Point> table() const;
};

/// Fits sigma^2 = sigma_range^2 + (slope * sigma_bearing)^2: bins up to 30 degrees off the normal
/// give the range's part, steeper ones the bearing's. Nullopt where no range has enough bins.
std::optional<RangeNoise> fit_range_noise(std::span<const BinSpread> bins);

}  // namespace cornerd::calibration
