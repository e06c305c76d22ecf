// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>

#include "calibration/bearing_bins.hpp"
#include "calibration/range_noise.hpp"
#include "calibration/wall_model.hpp"
#include "calibration/wall_search.hpp"

namespace cornerd::tool {

/// Sigma over range as SVG: a dot for each direction, median and quartiles of each range interval,
/// the fitted models as lines.
std::string draw_noise(const calibration::RangeNoise& noise,
                       std::span<const calibration::BinSpread> bins);

/// Range error over the ray's angle, as SVG: the returns as dots, the fitted model as a line for
/// each wall.
std::string draw_walls(std::span<const calibration::WallPieceFit> fits,
                       std::span<const calibration::KnownWall> walls);

}  // namespace cornerd::tool
