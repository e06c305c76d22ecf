// SPDX-License-Identifier: MIT
#pragma once

#ifndef __has_feature  // clang's, which compiles the sanitized builds
#define __has_feature(name) 0
#endif

namespace cornerd::test {

/// A sanitizer's own memory says nothing about the program's, and takes ten times as long.
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
inline constexpr bool kSanitized = true;
#else
inline constexpr bool kSanitized = false;
#endif

}  // namespace cornerd::test
