// SPDX-License-Identifier: MIT
#include "daemon/open_sockets.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "daemon/log.hpp"
#include "daemon/systemd.hpp"

namespace cornerd::daemon {

void open_sockets(MessageServer& server, const settings::SocketConfig& config) {
  std::vector<InheritedSocket> inherited = take_inherited_sockets();
  const auto open = [&](const std::filesystem::path& path, SocketRole role) {
    const auto found = std::find_if(inherited.begin(), inherited.end(),
                                    [&](const auto& socket) { return socket.path == path; });
    if (found == inherited.end()) return server.listen(path, role);
    server.listen(std::move(*found), role);
    inherited.erase(found);
  };
  open(config.pose, SocketRole::kPose);
  open(config.control, SocketRole::kControl);
  for (const InheritedSocket& socket : inherited) {
    log(LogLevel::kWarning,
        socket.path.string() +
            ": the service manager's socket is not used: set its path in /socket");
  }
}

}  // namespace cornerd::daemon
