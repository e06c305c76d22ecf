// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "calibration/wiring_faults.hpp"
#include "settings/config.hpp"

namespace cornerd::tool {

/// What is wrong and what to change for it, one line; empty where nothing is. Readings that are not
/// of odometry.source kernel are taken for lines of a controller's.
std::string describe_faults(const calibration::WiringFaults& faults,
                            const settings::OdometryConfig& config);

}  // namespace cornerd::tool
