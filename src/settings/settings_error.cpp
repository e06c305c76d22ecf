// SPDX-License-Identifier: MIT
#include <algorithm>

#include "settings/config.hpp"

namespace cornerd::settings {

std::string one_line(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](unsigned char c) { return c < 0x20 || c == 0x7f; }, '?');
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
