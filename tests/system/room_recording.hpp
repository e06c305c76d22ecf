// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>

namespace cornerd::system_test {

/// Where the recording is made: in a room of one kind of corner at each place, metres and radians.
inline constexpr double kTrueX = 0.8;
inline constexpr double kTrueY = 0.6;
inline constexpr double kTrueTheta = 0.5;

/// A room without symmetry, by that name.
void write_map(const std::filesystem::path& file, const std::string& room = "only");

/// `turns` turns of a lidar at rest in that room, ten a second.
void write_recording(const std::filesystem::path& file, int scans);

}  // namespace cornerd::system_test
