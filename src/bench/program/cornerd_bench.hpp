// SPDX-License-Identifier: MIT
#pragma once

namespace cornerd::bench {

/// The program; returns its exit code. Never throws.
int run_cornerd_bench(int argc, const char* const* argv);

}  // namespace cornerd::bench
