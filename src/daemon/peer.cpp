// SPDX-License-Identifier: MIT
#include "daemon/peer.hpp"

#include <sys/socket.h>

#include <algorithm>
#include <cerrno>

namespace cornerd::daemon {
namespace {

constexpr std::size_t kUsualGroups = 32;

/// Nothing where the kernel (before 4.13) cannot tell.
std::vector<gid_t> groups_of(int fd) {
  std::vector<gid_t> groups(kUsualGroups);
  socklen_t size = kUsualGroups * sizeof(gid_t);
  int result = ::getsockopt(fd, SOL_SOCKET, SO_PEERGROUPS, groups.data(), &size);
  if (result != 0 && errno == ERANGE) {
    groups.resize(size / sizeof(gid_t));
    result = ::getsockopt(fd, SOL_SOCKET, SO_PEERGROUPS, groups.data(), &size);
  }
  groups.resize(result == 0 ? size / sizeof(gid_t) : 0);
  return groups;
}

}  // namespace

std::optional<Peer> peer_of(int fd) {
  ucred credentials{};
  socklen_t size = sizeof(credentials);
  if (::getsockopt(fd, SOL_SOCKET, SO_PEERCRED, &credentials, &size) != 0) return std::nullopt;
  return Peer{credentials.uid, credentials.gid, groups_of(fd)};
}

bool belongs_to(const Peer& peer, gid_t group, uid_t owner) {
  return peer.user == 0 || peer.user == owner || peer.group == group ||
         std::find(peer.other_groups.begin(), peer.other_groups.end(), group) !=
             peer.other_groups.end();
}

}  // namespace cornerd::daemon
