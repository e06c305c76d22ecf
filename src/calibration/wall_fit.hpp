// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "calibration/wall_model.hpp"

namespace cornerd::calibration {

/// A return of a wall whose distance is known.
struct WallReturn {
  double distance_m = 0;  ///< of the wall: along its normal
  double ray_rad = 0;     ///< from the wall's normal, counter-clockwise
  double error_m = 0;     ///< measured less true range
};

/// One piece of the model, and how well it was told.
struct WallPieceFit {
  WallPiece piece;
  std::size_t ray_order = 0;
  std::size_t distance_order = 0;  ///< lower than the paper's where too few distances were measured
  std::size_t distances = 0;
  std::size_t returns = 0;
  double rms_m = 0;           ///< of the errors, before anything is fitted
  double beyond_3_sigma = 0;  ///< share of the rest; 0.0027 of a normal distribution
};

/// The three pieces of the paper, less those without measurements: to 0.6 m of order 6 in the ray
/// and 3 in the distance, to 1 m of orders 2 and 3, to 2.25 m of orders 2 and 1. Least squares over
/// all returns of a piece at once; what lies off by more than four sigmas is left out.
std::vector<WallPieceFit> fit_wall_model(std::span<const WallReturn> returns);

}  // namespace cornerd::calibration
