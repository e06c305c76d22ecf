// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <filesystem>

#include "tool/doctor/patient.hpp"

namespace cornerd::tool {

/// Reads the daemon's messages until a STATUS and some poses have come, at most for `at_most`.
DaemonView probe_daemon(const std::filesystem::path& socket, std::chrono::milliseconds at_most);

}  // namespace cornerd::tool
