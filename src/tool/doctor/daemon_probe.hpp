// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <filesystem>

#include "tool/doctor/patient.hpp"

namespace cornerd::tool {

/// Listens to the daemon until it has told its state and some poses, or until the time is over.
DaemonView probe_daemon(const std::filesystem::path& socket, std::chrono::milliseconds at_most);

}  // namespace cornerd::tool
