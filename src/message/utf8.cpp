// SPDX-License-Identifier: MIT
#include "message/utf8.hpp"

#include <cstdint>

namespace cornerd::message {
namespace {

bool is_within(std::uint8_t byte, std::uint8_t low, std::uint8_t high) {
  return byte >= low && byte <= high;
}

}  // namespace

std::size_t utf8_length(std::string_view text) {
  if (text.empty()) return 0;
  const auto byte = [text](std::size_t i) { return static_cast<std::uint8_t>(text[i]); };
  const std::uint8_t first = byte(0);
  if (first < 0x80) return 1;

  // RFC 3629, section 4: the second byte's limits keep out overlong forms, surrogates and what lies
  // beyond U+10FFFF.
  std::size_t length = 0;
  std::uint8_t low = 0x80;
  std::uint8_t high = 0xbf;
  if (is_within(first, 0xc2, 0xdf)) {
    length = 2;
  } else if (is_within(first, 0xe0, 0xef)) {
    length = 3;
    if (first == 0xe0) low = 0xa0;
    if (first == 0xed) high = 0x9f;
  } else if (is_within(first, 0xf0, 0xf4)) {
    length = 4;
    if (first == 0xf0) low = 0x90;
    if (first == 0xf4) high = 0x8f;
  }
  if (length == 0 || text.size() < length || !is_within(byte(1), low, high)) return 0;
  for (std::size_t i = 2; i < length; ++i) {
    if (!is_within(byte(i), 0x80, 0xbf)) return 0;
  }
  return length;
}

}  // namespace cornerd::message
