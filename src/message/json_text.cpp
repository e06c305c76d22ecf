// SPDX-License-Identifier: MIT
#include "message/json_text.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>

namespace cornerd::message {
namespace {

constexpr std::array<std::int64_t, 10> kPowersOfTen = {
    1, 10, 100, 1'000, 10'000, 100'000, 1'000'000, 10'000'000, 100'000'000, 1'000'000'000};
constexpr std::string_view kHexDigits = "0123456789abcdef";

/// Largest scaled value: the next power of ten exceeds a double's 53 bits of mantissa.
constexpr double kLargestScaled = 9e15;

/// pi in microradians, rounded down.
constexpr std::int64_t kPiInMicroradians = 3'141'592;

template <typename Value, typename... Format>
void append_digits(std::string& text, Value value, Format... format) {
  std::array<char, 32> digits;
  text.append(digits.data(), std::to_chars(digits.begin(), digits.end(), value, format...).ptr);
}

bool is_within(std::uint8_t byte, std::uint8_t low, std::uint8_t high) {
  return byte >= low && byte <= high;
}

}  // namespace

void JsonText::separate() {
  if (text_.empty()) return;
  const char last = text_.back();
  if (last != '{' && last != '[' && last != ':') text_ += ',';
}

void JsonText::key(std::string_view name) {
  string(name);
  text_ += ':';
}

void JsonText::number(std::string_view name, double value, int decimals) {
  if (!std::isfinite(value)) return;
  key(name);
  fixed(value, decimals);
}

void JsonText::string(std::string_view value) {
  separate();
  text_ += '"';
  while (!value.empty()) {
    const unsigned char c = static_cast<unsigned char>(value.front());
    const std::size_t length = utf8_length(value);
    if (length == 0) {
      text_ += "\\ufffd";
    } else if (c == '"' || c == '\\') {
      text_ += '\\';
      text_ += value.front();
    } else if (c == '\n') {
      text_ += "\\n";
    } else if (c < 0x20 || c == 0x7f) {
      text_ += "\\u00";
      text_ += kHexDigits[c >> 4];
      text_ += kHexDigits[c & 0xf];
    } else {
      text_ += value.substr(0, length);
    }
    value.remove_prefix(std::max<std::size_t>(length, 1));
  }
  text_ += '"';
}

void JsonText::raw(std::string_view json) {
  separate();
  text_ += json;
}

void JsonText::append_integer(std::int64_t value) { append_digits(text_, value); }
void JsonText::append_integer(std::uint64_t value) { append_digits(text_, value); }

void JsonText::append_scaled(std::int64_t scaled, int decimals, bool keep_zeros) {
  const std::int64_t power = kPowersOfTen[static_cast<std::size_t>(decimals)];
  if (scaled < 0) {
    text_ += '-';
    scaled = -scaled;
  }
  append_integer(scaled / power);
  std::int64_t fraction = scaled % power;
  if (decimals == 0 || (fraction == 0 && !keep_zeros)) return;
  std::array<char, 10> digits;
  digits[0] = '.';
  for (int i = decimals; i > 0; --i) {
    digits[static_cast<std::size_t>(i)] = static_cast<char>('0' + fraction % 10);
    fraction /= 10;
  }
  auto end = digits.begin() + decimals + 1;
  while (!keep_zeros && end[-1] == '0') --end;
  text_.append(digits.begin(), end);
}

void JsonText::fixed(double value, int decimals) {
  const double scaled =
      value * static_cast<double>(kPowersOfTen[static_cast<std::size_t>(decimals)]);
  if (std::abs(scaled) > kLargestScaled) {
    significant(value);
    return;
  }
  separate();
  append_scaled(std::llround(scaled), decimals, false);
}

void JsonText::significant(double value) {
  separate();
  if (value == 0) {
    text_ += '0';
    return;
  }
  append_digits(text_, value, std::chars_format::general, 6);
}

void JsonText::shortest(double value) {
  separate();
  append_digits(text_, value);
}

void JsonText::angle(double value_rad) {
  separate();
  append_scaled(std::clamp<std::int64_t>(std::llround(value_rad * 1e6), -kPiInMicroradians,
                                         kPiInMicroradians),
                6, false);
}

void JsonText::seconds(core::TimeNs t_ns) {
  separate();
  const std::int64_t rounded = t_ns / 1000 + (t_ns % 1000 >= 500) - (t_ns % 1000 <= -500);
  append_scaled(rounded, 6, true);
}

void JsonText::hex(std::span<const std::uint8_t> bytes) {
  separate();
  text_ += '"';
  for (const std::uint8_t byte : bytes) {
    text_ += kHexDigits[byte >> 4];
    text_ += kHexDigits[byte & 0xf];
  }
  text_ += '"';
}

std::size_t utf8_length(std::string_view text) {
  if (text.empty()) return 0;
  const auto byte = [text](std::size_t i) { return static_cast<std::uint8_t>(text[i]); };
  const std::uint8_t first = byte(0);
  if (first < 0x80) return 1;

  // RFC 3629, section 4: the limits of the second byte exclude overlong forms, surrogates and code
  // points above U+10FFFF.
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
