// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

namespace cornerd::tool {

/// Records what a running daemon reads, from its socket: SCAN and ODOMETRY as they come, in a file
/// *.ndjson. `seconds`: the duration; 0: until interrupted. Goes on when the daemon returns. Throws
/// Failure if there is no daemon, or neither comes.
void record_from_daemon(const std::filesystem::path& socket, const std::filesystem::path& file,
                        double seconds);

}  // namespace cornerd::tool
