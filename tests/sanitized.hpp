// SPDX-License-Identifier: MIT
#pragma once

namespace cornerd::test {

/// A sanitizer's own memory says nothing about the program's, and takes ten times as long.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr bool kSanitized = true;
#else
inline constexpr bool kSanitized = false;
#endif

}  // namespace cornerd::test
