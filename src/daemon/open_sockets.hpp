// SPDX-License-Identifier: MIT
#pragma once

#include "daemon/message_server.hpp"
#include "settings/config.hpp"

namespace cornerd::daemon {

/// Both sockets: the service manager's, where it has passed them on, or new ones. Throws
/// std::system_error.
void open_sockets(MessageServer& server, const settings::SocketConfig& config);

}  // namespace cornerd::daemon
