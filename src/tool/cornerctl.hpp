// SPDX-License-Identifier: MIT
#pragma once

namespace cornerd::tool {

/// The program: what main() returns. Prints to standard output and standard error, never throws.
int run_cornerctl(int argc, const char* const* argv);

}  // namespace cornerd::tool
