// SPDX-License-Identifier: MIT
#pragma once

namespace cornerd::test {

/// A sanitizer's own memory says nothing about the program's, and takes ten times as long.
#ifdef CORNERD_SANITIZED
inline constexpr bool kSanitized = true;
#else
inline constexpr bool kSanitized = false;
#endif

}  // namespace cornerd::test
