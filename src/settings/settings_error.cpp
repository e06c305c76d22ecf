// SPDX-License-Identifier: MIT
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

}  // namespace

std::string one_line(std::string text) {
  for (std::size_t i = 0; i < text.size(); ++i) {
    const std::size_t length = control_length(std::string_view(text).substr(i));
    if (length > 0) text.replace(i, length, "?");
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
