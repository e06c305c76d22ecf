// SPDX-License-Identifier: MIT
// A file of JSON with // comments, parsed with strict checks: people write it by hand.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

#include "settings/config.hpp"

namespace cornerd::settings {

using Json = nlohmann::json;

/// The whole file. Throws SettingsError where it cannot be read, is longer than `max_bytes`, or is
/// of another kind.
std::string read_file(const std::filesystem::path& file, std::size_t max_bytes,
                      FileKind kind = FileKind::kAny);

/// Throws SettingsError with line and column where the text is not JSON, and with the pointer where
/// an object has a key twice or is nested more than 16 deep.
Json parse_document(std::string_view text, const std::filesystem::path& file);

/// The pointer of a child: RFC 6901.
std::string child_pointer(const std::string& parent, std::string_view key);

/// True for "/json/pointer=value".
bool is_override(std::string_view text);

/// Puts "/json/pointer=value" into the document; a value that is not JSON is taken as a string.
/// Returns the pointer. Throws SettingsError.
std::string apply_override(Json& document, std::string_view text);

}  // namespace cornerd::settings
