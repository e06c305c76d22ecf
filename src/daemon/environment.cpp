// SPDX-License-Identifier: MIT
#include "daemon/environment.hpp"

#include <charconv>
#include <cstdlib>
#include <cstring>

namespace cornerd::daemon {

std::optional<std::uint64_t> number_in_environment(const char* name) {
  const char* text = std::getenv(name);
  if (text == nullptr) return std::nullopt;
  std::uint64_t number = 0;
  const char* end = text + std::strlen(text);
  const auto result = std::from_chars(text, end, number);
  if (result.ec != std::errc() || result.ptr != end) return std::nullopt;
  return number;
}

}  // namespace cornerd::daemon
