// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <istream>
#include <optional>

namespace cornerd::daemon {

/// Whether somebody listens on the socket of this file, as far as the kernel's list of this network
/// namespace goes; nullopt where it cannot be read. It tells where connect() is not allowed.
std::optional<bool> somebody_listens(const std::filesystem::path& file);

/// The same of such a list: the text of /proc/net/unix. A relative name in it, which may be from
/// anywhere, counts where it ends as the file does.
bool somebody_listens(const std::filesystem::path& file, std::istream& list);

}  // namespace cornerd::daemon
