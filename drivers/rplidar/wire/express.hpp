// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>

#include "drivers/rplidar/wire/capsule.hpp"

namespace cornerd::rplidar {

/// The samples of an express capsule (answer type 0x82): whole millimetres, angles corrected by the
/// core in eighths of a degree.
void decode_express(std::span<const std::uint8_t, kExpressSize> capsule, const Sweep& sweep,
                    std::span<SweepSample, kExpressSamples> samples);

}  // namespace cornerd::rplidar
