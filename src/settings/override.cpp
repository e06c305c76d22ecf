// SPDX-License-Identifier: MIT
#include "settings/override.hpp"

#include <algorithm>

#include "settings/config.hpp"

namespace cornerd::settings {
namespace {

/// RFC 6901, section 4.
std::string unescape(std::string_view token) {
  std::string key;
  for (std::size_t i = 0; i < token.size(); ++i) {
    if (token[i] == '~' && i + 1 < token.size()) {
      key += token[++i] == '1' ? '/' : '~';
    } else {
      key += token[i];
    }
  }
  return key;
}

}  // namespace

bool is_override(std::string_view text) {
  const std::size_t equals = text.find('=');
  return equals != std::string_view::npos && equals >= 2 && text.front() == '/';
}

std::string apply_override(Json& document, std::string_view text) {
  const std::size_t equals = text.find('=');
  const std::string pointer(text.substr(0, equals));
  if (!is_override(text)) {
    throw SettingsError("override \"" + std::string(text) + "\"", "",
                        "must be /json/pointer=value");
  }
  Json* target = &document;
  std::string_view rest = std::string_view(pointer).substr(1);
  for (bool is_last = false; !is_last;) {
    const std::size_t slash = rest.find('/');
    is_last = slash == std::string_view::npos;
    const std::string key = unescape(rest.substr(0, slash));
    if (!is_last) rest.remove_prefix(slash + 1);
    if (target->is_null()) *target = Json::object();
    if (!target->is_object()) {
      throw SettingsError("override", pointer, "\"" + key + "\" would be inside what is no object");
    }
    target = &(*target)[key];
  }
  const std::string_view value = text.substr(equals + 1);
  *target = Json::parse(value, nullptr, /*allow_exceptions=*/false);
  if (target->is_discarded()) *target = std::string(value);
  return pointer;
}

}  // namespace cornerd::settings
