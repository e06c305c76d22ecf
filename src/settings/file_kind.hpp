// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace cornerd::settings {

/// What may be read as a file. Whoever must not wait for another's bytes takes ordinary files
/// alone: of a pipe that nobody writes, opening it does not return.
enum class FileKind : std::uint8_t { kOrdinary, kAny };

}  // namespace cornerd::settings
