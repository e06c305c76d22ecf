// SPDX-License-Identifier: MIT
#pragma once

namespace cornerd::daemon {

/// Logs go to standard error, with the time of day unless the journal adds it. Only one thread may
/// log; logging never blocks.
void set_up_log();

}  // namespace cornerd::daemon
