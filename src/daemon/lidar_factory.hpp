// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "drivers/lidar_driver.hpp"
#include "settings/config.hpp"

namespace cornerd::daemon {

/// The driver of /lidar/driver. It opens the device or file when it runs.
std::unique_ptr<drivers::LidarDriver> make_lidar(const settings::LidarConfig& config);

}  // namespace cornerd::daemon
