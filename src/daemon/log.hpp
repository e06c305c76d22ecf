// SPDX-License-Identifier: MIT
#pragma once

namespace cornerd::daemon {

/// Logs go to standard error: with the time of day, or without it where the journal adds its own.
/// One thread logs, and waits for nobody.
void set_up_log();

}  // namespace cornerd::daemon
