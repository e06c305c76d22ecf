// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "calibration/range_noise.hpp"

namespace cornerd::tool {

/// For people: what was measured range by range, and how far the models are from it.
std::string describe_noise(const calibration::RangeNoise& noise);

/// For config files, `simulate --noise` and `emulate --noise`: { "lidar": { "noise": ... } }.
/// `with_table`: with the measured ranges, which then count instead of floor and share.
std::string noise_fragment(const calibration::RangeNoise& noise, bool with_table);

}  // namespace cornerd::tool
