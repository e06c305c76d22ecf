// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

#include "settings/document.hpp"

namespace cornerd::settings {

/// True for "/json/pointer=value".
bool is_override(std::string_view text);

/// Puts "/json/pointer=value" into the document; the value is JSON, or else taken as a string.
/// Returns the pointer. Throws SettingsError.
std::string apply_override(Json& document, std::string_view text);

}  // namespace cornerd::settings
