// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>

#include "calibration/bearing_bins.hpp"
#include "calibration/range_noise.hpp"

namespace cornerd::tool {

/// Sigma over range as SVG: every direction a dot, the measured ranges with their quartiles, the
/// fitted models as lines.
std::string draw_noise(const calibration::RangeNoise& noise,
                       std::span<const calibration::BinSpread> bins);

}  // namespace cornerd::tool
