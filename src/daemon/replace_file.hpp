// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string_view>

namespace cornerd::daemon {

/// Replaces the file's content atomically: after a crash or power cut the old or the new content is
/// complete. Throws std::system_error.
void replace_file(const std::filesystem::path& file, std::string_view text);

}  // namespace cornerd::daemon
