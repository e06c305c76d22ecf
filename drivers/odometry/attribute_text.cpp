// SPDX-License-Identifier: MIT
#include "drivers/odometry/attribute_text.hpp"

#include <charconv>
#include <cmath>
#include <system_error>

namespace cornerd::drivers {
namespace {

template <typename Number, typename... Format>
std::optional<Number> parse_whole(std::string_view text, Format... format) {
  text = without_newline(text);
  Number value{};
  const char* const end = text.data() + text.size();
  const auto [stopped, error] = std::from_chars(text.data(), end, value, format...);
  if (error != std::errc{} || stopped != end) return std::nullopt;
  return value;
}

}  // namespace

std::string_view without_newline(std::string_view text) {
  if (text.ends_with('\n')) text.remove_suffix(1);
  return text;
}

std::optional<std::int64_t> parse_integer(std::string_view text) {
  return parse_whole<std::int64_t>(text);
}

std::optional<double> parse_decimal(std::string_view text) {
  const auto value = parse_whole<double>(text, std::chars_format::fixed);
  return value && std::isfinite(*value) ? value : std::nullopt;  // "inf" and "nan" are numbers too
}

}  // namespace cornerd::drivers
