// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <vector>

#include "daemon/require_fd.hpp"

namespace cornerd::daemon {

/// A socket that listens already: the service manager's, see sd_listen_fds(3).
struct InheritedSocket {
  std::filesystem::path path;  ///< that it is bound to
  FileDescriptor fd;           ///< non-blocking
};

/// Those that were passed to this process ($LISTEN_PID, $LISTEN_FDS), as far as they are UNIX
/// stream sockets that listen; others are closed. Takes them over: a second call finds none.
std::vector<InheritedSocket> take_inherited_sockets();

}  // namespace cornerd::daemon
