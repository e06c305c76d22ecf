// SPDX-License-Identifier: MIT
#pragma once

namespace cornerd::web {

/// The program; returns its exit code.
int run_cornerd_web(int argc, const char* const* argv);

}  // namespace cornerd::web
