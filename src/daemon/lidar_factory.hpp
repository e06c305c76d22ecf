// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "drivers/lidar_driver.hpp"
#include "settings/config.hpp"

namespace cornerd::daemon {

/// The driver that the settings name. It opens nothing before it runs.
std::unique_ptr<drivers::LidarDriver> make_lidar(const settings::LidarConfig& config);

}  // namespace cornerd::daemon
