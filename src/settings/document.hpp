// SPDX-License-Identifier: MIT
// A file of JSON with // comments, read with the care that a person's typing needs.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

#include "settings/config.hpp"

namespace cornerd::settings {

using Json = nlohmann::json;

/// The whole file. Throws SettingsError where it cannot be read, is longer than `max_bytes` or of
/// another kind.
std::string read_file(const std::filesystem::path& file, std::size_t max_bytes,
                      FileKind kind = FileKind::kAny);

/// Throws SettingsError with line and column where the text is no JSON, and with the pointer where
/// an object has a key twice or the nesting is deeper than any settings need.
Json parse_document(std::string_view text, const std::filesystem::path& file);

/// The pointer of a child: RFC 6901.
std::string child_pointer(const std::string& parent, std::string_view key);

}  // namespace cornerd::settings
