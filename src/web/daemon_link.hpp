// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <functional>
#include <stop_token>
#include <string_view>

#include "client/subscription.hpp"

namespace cornerd::web {

/// Reads the pose socket until `stop`, also while the daemon is absent. `tell`: kMessage with the
/// line, kConnected, and kLost with the reason; called on this thread.
void follow_daemon(const std::filesystem::path& pose_socket, const std::stop_token& stop,
                   const std::function<void(client::Event, std::string_view)>& tell);

}  // namespace cornerd::web
