// SPDX-License-Identifier: MIT
// The daemon's log. Lines are formatted by the caller, so that only log.cpp includes spdlog, which
// costs five seconds of compilation.
#pragma once

#include <cstdint>
#include <string_view>

namespace cornerd::daemon {

enum class LogLevel : std::uint8_t { kDebug, kInfo, kWarning, kError };

/// Logs go to standard error, with the time of day unless the journal adds it. Only one thread may
/// log; logging never blocks.
void set_up_log();

void log(LogLevel level, std::string_view line);

}  // namespace cornerd::daemon
