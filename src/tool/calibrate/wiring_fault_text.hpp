// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "calibration/wiring_faults.hpp"
#include "settings/config.hpp"

namespace cornerd::tool {

/// Faults and remedies in one line; empty if there are none. Without odometry.source kernel, the
/// remedies refer to the controller's ODOMETRY lines.
std::string describe_faults(const calibration::WiringFaults& faults,
                            const settings::OdometryConfig& config);

}  // namespace cornerd::tool
