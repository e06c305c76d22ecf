// SPDX-License-Identifier: MIT
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <filesystem>
#include <istream>
#include <optional>
#include <vector>

#include "daemon/rate_limited_log.hpp"
#include "daemon/require_fd.hpp"

namespace cornerd::daemon {

/// A listening UNIX stream socket with a path.
class UnixListener {
 public:
  /// Replaces a stale socket file. Throws std::runtime_error if another process listens on it or
  /// the socket cannot be made.
  UnixListener(const std::filesystem::path& path, mode_t mode);
  /// Takes over a listening socket whose file belongs to the service manager.
  UnixListener(const std::filesystem::path& path, FileDescriptor inherited);
  /// Removes the socket file unless another process replaced it.
  ~UnixListener();
  UnixListener(const UnixListener&) = delete;
  UnixListener& operator=(const UnixListener&) = delete;

  int fd() const { return fd_.get(); }
  const std::filesystem::path& path() const { return path_; }
  /// All but kOwn: clients cannot connect. kReplaced: by something of somebody else. kClosed: the
  /// file's mode denies what it allowed at the start.
  enum class File : std::uint8_t { kOwn, kRemoved, kReplaced, kClosed };
  File file() const;
  /// The next waiting client, non-blocking; not open if there is none. If the process is out of
  /// descriptors, the client is disconnected, since it would keep the event loop busy.
  FileDescriptor accept();
  /// Group of the socket file.
  gid_t group() const { return group_; }

 private:
  std::filesystem::path path_;
  FileDescriptor fd_;
  FileDescriptor spare_;  ///< closed to accept and disconnect a client without a descriptor
  RateLimitedLog turned_away_{LogLevel::kWarning, "a client is turned away"};
  gid_t group_ = 0;
  mode_t writers_ = 0;  ///< whom the file's mode allows to connect
  dev_t device_ = 0;
  ino_t inode_ = 0;         ///< 0: not known
  bool owns_file_ = false;  ///< it is removed at the end
};

/// True if a process listens on the socket file, by /proc/self/net/unix; nullopt if that cannot be
/// read. Works for sockets of other users, where connect() is refused.
std::optional<bool> is_listening(const std::filesystem::path& file);

/// `list`: the text of /proc/net/unix. A relative path in it matches if its file name does.
bool is_listening(const std::filesystem::path& file, std::istream& list);

/// Credentials of the process at the other end of a connection.
struct Peer {
  uid_t user = 0;
  gid_t group = 0;
  std::vector<gid_t> other_groups;
};

/// nullopt if `fd` is not a UNIX socket.
std::optional<Peer> peer_of(int fd);

/// True for members of `group`, root, and `owner`.
bool belongs_to(const Peer& peer, gid_t group, uid_t owner);

}  // namespace cornerd::daemon
