// SPDX-License-Identifier: MIT
#pragma once

namespace cornerd::mqtt {

/// The program; returns its exit code.
int run_cornerd_mqtt(int argc, const char* const* argv);

}  // namespace cornerd::mqtt
