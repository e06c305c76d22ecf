// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cstddef>
#include <string_view>

#include "settings/config.hpp"

namespace cornerd::settings {

namespace {

/// Bytes of the control character at the start of `text`; 0 where there is none.
std::size_t control_length(std::string_view text) {
  const auto first = static_cast<unsigned char>(text[0]);
  if (first < 0x20 || first == 0x7f) return 1;
  // U+0080 to U+009F in UTF-8: U+009B starts a terminal command, as ESC [ does.
  const auto second = static_cast<unsigned char>(text.size() > 1 ? text[1] : 0);
  return first == 0xc2 && second >= 0x80 && second < 0xa0 ? 2 : 0;
}

/// Bytes of the UTF-8 character at the start of `text`; 0 where there is none.
std::size_t character_length(std::string_view text) {
  const auto byte = [&](std::size_t i) {
    return static_cast<unsigned char>(i < text.size() ? text[i] : 0);
  };
  const unsigned char first = byte(0);
  const std::size_t length = first < 0x80   ? 1
                             : first < 0xc2 ? 0
                             : first < 0xe0 ? 2
                             : first < 0xf0 ? 3
                             : first < 0xf5 ? 4
                                            : 0;
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xc0) != 0x80) return 0;
  }
  return length;
}

}  // namespace

std::string one_line(std::string text) {
  for (std::size_t i = 0; i < text.size();) {
    const std::string_view rest = std::string_view(text).substr(i);
    const std::size_t control = control_length(rest);
    const std::size_t length = character_length(rest);
    const bool is_shown = control == 0 && length > 0;
    // The journal hides a line that is no UTF-8.
    if (!is_shown) text.replace(i, std::max<std::size_t>(control, 1), "?");
    i += is_shown ? length : 1;
  }
  return text;
}

namespace {

std::string compose(const std::string& file, const std::string& pointer,
                    const std::string& reason) {
  std::string text = file.empty() ? "config" : file;
  text += ": ";
  if (!pointer.empty()) text += pointer + ": ";
  return one_line(text + reason);
}

}  // namespace

SettingsError::SettingsError(const std::string& file, const std::string& pointer,
                             const std::string& reason)
    : std::runtime_error(compose(file, pointer, reason)) {}

}  // namespace cornerd::settings
