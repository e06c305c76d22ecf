// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <vector>

#include "core/odometry/odometry_reading.hpp"

namespace cornerd::tool {

/// The ODOMETRY lines of a file in the order that they stand in; other lines are passed over.
/// Throws Failure where the file cannot be read, has a bad line or not one reading.
std::vector<core::OdometryReading> load_odometry(const std::filesystem::path& file);

}  // namespace cornerd::tool
