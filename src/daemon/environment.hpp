// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>

namespace cornerd::daemon {

/// A variable as a decimal number; nullopt where it is not set, or is anything else.
std::optional<std::uint64_t> number_in_environment(const char* name);

}  // namespace cornerd::daemon
