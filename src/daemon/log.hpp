// SPDX-License-Identifier: MIT
// The daemon's log. Lines come formatted, so that spdlog and fmt stay in log.cpp and log_sink.cpp:
// they cost each file that includes them five seconds of compilation.
#pragma once

#include <cstdint>
#include <string_view>

namespace cornerd::daemon {

enum class LogLevel : std::uint8_t { kDebug, kInfo, kWarning, kError };

/// Logs go to standard error: with the time of day, or without it where the journal adds its own.
/// One thread logs, and never waits.
void set_up_log();

void log(LogLevel level, std::string_view line);

}  // namespace cornerd::daemon
