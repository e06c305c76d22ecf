// SPDX-License-Identifier: MIT
#pragma once

#include <sys/types.h>

#include <filesystem>

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
  bool is_there() const;
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

}  // namespace cornerd::daemon
