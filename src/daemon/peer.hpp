// SPDX-License-Identifier: MIT
#pragma once

#include <sys/types.h>

#include <optional>
#include <vector>

namespace cornerd::daemon {

/// Who is at the other end of a connection, as the kernel knows it.
struct Peer {
  uid_t user = 0;
  gid_t group = 0;
  std::vector<gid_t> other_groups;
};

/// Of a UNIX socket; nullopt where the kernel does not tell.
std::optional<Peer> peer_of(int fd);

/// Whether that one may do what members of `group` may: as one of them, as root, or as `owner`.
bool belongs_to(const Peer& peer, gid_t group, uid_t owner);

}  // namespace cornerd::daemon
