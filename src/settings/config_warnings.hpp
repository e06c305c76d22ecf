// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "settings/config.hpp"

namespace cornerd::settings {

/// Of what is allowed, and hardly meant: two of "maps" that are one file, a lidar metres beside the
/// robot.
std::vector<std::string> warnings_of(const Config& config);

}  // namespace cornerd::settings
