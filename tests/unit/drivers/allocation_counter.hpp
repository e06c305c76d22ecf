// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

namespace cornerd::test {

/// Calls of operator new by any thread of this program so far.
std::size_t allocations();

}  // namespace cornerd::test
