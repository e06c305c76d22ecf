// SPDX-License-Identifier: MIT
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <istream>
#include <optional>
#include <vector>

#include "daemon/require_fd.hpp"

namespace cornerd::daemon {

/// A listening UNIX stream socket with a name in the file system, removed at the end.
class UnixListener {
 public:
  /// A socket file that nobody listens on any more is replaced; one that somebody does is left
  /// alone. Throws std::runtime_error, one line with the path.
  UnixListener(const std::filesystem::path& path, mode_t mode);
  /// Of a socket that listens there already; the file is somebody else's to remove.
  UnixListener(const std::filesystem::path& path, FileDescriptor inherited);
  /// Removes the file where it is still this socket's.
  ~UnixListener();
  UnixListener(const UnixListener&) = delete;
  UnixListener& operator=(const UnixListener&) = delete;

  int fd() const { return fd_.get(); }
  const std::filesystem::path& path() const { return path_; }
  /// False once somebody has removed the file: no client finds the socket any more.
  bool file_exists() const;
  /// The next waiting client, non-blocking; not open where there is none. One that there is no
  /// descriptor left for is sent away: it would keep the loop busy.
  FileDescriptor accept();
  /// The group of the file.
  gid_t group() const { return group_; }

 private:
  std::filesystem::path path_;
  FileDescriptor fd_;
  FileDescriptor spare_;  ///< to be given up for such a client
  gid_t group_ = 0;
  dev_t device_ = 0;
  ino_t inode_ = 0;
};

/// Whether somebody listens on the socket of this file, as far as the kernel's list of this network
/// namespace goes; nullopt where it cannot be read. It tells where connect() is not allowed.
std::optional<bool> is_listening(const std::filesystem::path& file);

/// The same of such a list: the text of /proc/net/unix. A relative name in it, which may be from
/// anywhere, counts where it ends as the file does.
bool is_listening(const std::filesystem::path& file, std::istream& list);

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
