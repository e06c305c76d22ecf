// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>

namespace cornerd::system_test {

/// Pose of the lidar in the recording, metres and radians.
inline constexpr double kTrueX = 0.8;
inline constexpr double kTrueY = 0.6;
inline constexpr double kTrueTheta = 0.5;

/// A room without symmetry.
void write_map(const std::filesystem::path& file, const std::string& room = "only");

/// Another room, of the same kind.
void write_other_map(const std::filesystem::path& file);

/// `scans` scans of a lidar at rest in the room, 10 Hz; then, in as many, it is driven 1.2 m along
/// x where it `drives`.
void write_recording(const std::filesystem::path& file, int scans, bool drives = false);

}  // namespace cornerd::system_test
