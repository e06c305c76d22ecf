// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdarg>
#include <cstdio>
#include <string>

namespace cornerd::tool {

/// printf to a string of at most 255 bytes.
__attribute__((format(printf, 1, 2))) inline std::string formatted(const char* format, ...) {
  std::array<char, 256> text{};
  va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(text.data(), text.size(), format, arguments);
  va_end(arguments);
  return text.data();
}

}  // namespace cornerd::tool
