// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string_view>

namespace cornerd::daemon {

/// Puts `text` in the place of what the file held. Whoever is killed, or loses power, in between
/// leaves the old file or the new one, whole. Throws std::system_error.
void replace_file(const std::filesystem::path& file, std::string_view text);

}  // namespace cornerd::daemon
