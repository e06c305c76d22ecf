// SPDX-License-Identifier: MIT
#pragma once

namespace cornerd::bench {

/// The program: what main() returns. Prints to standard output and standard error, never throws.
int run_cornerd_bench(int argc, const char* const* argv);

}  // namespace cornerd::bench
