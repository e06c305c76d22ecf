// SPDX-License-Identifier: MIT
#include "daemon/unix_listener.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <fstream>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>

#include "daemon/posix_clock.hpp"
#include "drivers/config/open_files.hpp"

namespace cornerd::daemon {
namespace {

constexpr int kBacklog = 16;
/// connect() needs write permission, unix(7).
constexpr mode_t kWriters = S_IWUSR | S_IWGRP | S_IWOTH;

[[noreturn]] void fail(const std::filesystem::path& path, const std::string& reason) {
  throw std::runtime_error(path.string() + ": " + reason);
}

sockaddr_un address_of(const std::filesystem::path& path) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  const std::string& name = path.native();
  if (name.size() >= sizeof(address.sun_path))
    fail(path, "the path is too long for a socket: use at most 107 bytes");
  std::memcpy(address.sun_path, name.data(), name.size());
  return address;
}

const sockaddr* generic(const sockaddr_un& address) {
  return reinterpret_cast<const sockaddr*>(&address);
}

FileDescriptor make_socket() {
  return require_fd(::socket(AF_UNIX, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0), "socket");
}

/// Serializes instances that start at the same time: a socket that is bound but does not listen yet
/// looks stale. Gives up after 1 s, since no cornerd holds the lock that long.
FileDescriptor lock_folder(const std::filesystem::path& path) {
  const std::filesystem::path folder = path.has_parent_path() ? path.parent_path() : ".";
  FileDescriptor fd(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  for (int tries = 0; tries < 50 && fd.is_open() && ::flock(fd.get(), LOCK_EX | LOCK_NB) != 0;
       ++tries) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  return fd;
}

FileDescriptor make_spare() { return FileDescriptor(::open("/dev/null", O_RDONLY | O_CLOEXEC)); }

/// Why the socket file must not be removed; nullopt if it is stale.
std::optional<std::string> why_in_use(const std::filesystem::path& path,
                                      const sockaddr_un& address) {
  const FileDescriptor probe = make_socket();
  const bool answers = ::connect(probe.get(), generic(address), sizeof(address)) == 0;
  const int error = errno;
  // EAGAIN: the backlog of a live listener is full.
  if (answers || error == EAGAIN) {
    return "another cornerd listens on this socket: stop it, or set another path in /socket";
  }
  if (error == ECONNREFUSED) return std::nullopt;
  if (error != EACCES) {
    return std::string("cannot connect to the existing socket: ") + std::strerror(error) +
           "; remove the file if no cornerd runs";
  }
  // Another user's socket.
  const std::optional<bool> listens = is_listening(path);
  if (!listens) {
    return "the socket belongs to another user, and /proc/net/unix cannot be read: remove the file "
           "if no cornerd runs";
  }
  if (*listens) {
    return "another user's cornerd listens on this socket: stop it, or set another path in /socket";
  }
  return std::nullopt;
}

void remove_stale(const std::filesystem::path& path, const sockaddr_un& address) {
  struct stat file {};
  if (::lstat(path.c_str(), &file) != 0) return;
  if (!S_ISSOCK(file.st_mode))
    fail(path, "exists and is not a socket: remove it, or set another path");
  if (const auto reason = why_in_use(path, address)) fail(path, *reason);
  if (::unlink(path.c_str()) != 0 && errno != ENOENT) {
    fail(path, std::string("cannot remove the stale socket: ") + std::strerror(errno));
  }
}

/// __SO_ACCEPTCON of linux/net.h, in the column of flags.
constexpr unsigned long kListens = 0x10000;

bool is_same(const std::filesystem::path& file, const std::filesystem::path& listed) {
  if (listed.is_relative()) return listed.filename() == file.filename();
  if (listed == file) return true;
  struct stat one {};
  struct stat other {};
  return ::stat(listed.c_str(), &one) == 0 && ::stat(file.c_str(), &other) == 0 &&
         one.st_dev == other.st_dev && one.st_ino == other.st_ino;
}

constexpr std::size_t kFirstGroups = 32;

/// Empty before Linux 4.13.
std::vector<gid_t> groups_of(int fd) {
  std::vector<gid_t> groups(kFirstGroups);
  socklen_t size = kFirstGroups * sizeof(gid_t);
  int result = ::getsockopt(fd, SOL_SOCKET, SO_PEERGROUPS, groups.data(), &size);
  if (result != 0 && errno == ERANGE) {
    groups.resize(size / sizeof(gid_t));
    result = ::getsockopt(fd, SOL_SOCKET, SO_PEERGROUPS, groups.data(), &size);
  }
  groups.resize(result == 0 ? size / sizeof(gid_t) : 0);
  return groups;
}

}  // namespace

UnixListener::UnixListener(const std::filesystem::path& path, mode_t mode)
    : path_(path), spare_(make_spare()) {
  const sockaddr_un address = address_of(path);
  std::error_code failed;
  if (path.has_parent_path()) std::filesystem::create_directory(path.parent_path(), failed);
  if (failed && !std::filesystem::exists(path.parent_path())) {
    fail(path.parent_path(), "cannot create the socket's folder: " + failed.message());
  }
  const FileDescriptor lock = lock_folder(path);
  remove_stale(path, address);
  fd_ = make_socket();
  if (::bind(fd_.get(), generic(address), sizeof(address)) != 0) {
    fail(path, std::string("cannot bind the socket: ") + std::strerror(errno));
  }
  struct stat file {};
  if (::stat(path.c_str(), &file) == 0) {
    device_ = file.st_dev;
    inode_ = file.st_ino;
    owns_file_ = true;
    group_ = file.st_gid;
    writers_ = mode & kWriters;
  }
  // After bind(), because the umask limits the mode; before listen(), because no client can connect
  // until then.
  if (::chmod(path.c_str(), mode) != 0 || ::listen(fd_.get(), kBacklog) != 0) {
    const std::string reason = std::strerror(errno);
    ::unlink(path.c_str());
    fail(path, "cannot listen on the socket: " + reason);
  }
}

UnixListener::UnixListener(const std::filesystem::path& path, FileDescriptor inherited)
    : path_(path), fd_(std::move(inherited)), spare_(make_spare()) {
  struct stat file {};
  if (::stat(path.c_str(), &file) != 0) return;
  device_ = file.st_dev;
  inode_ = file.st_ino;
  group_ = file.st_gid;
  writers_ = file.st_mode & kWriters;
}

UnixListener::~UnixListener() {
  if (owns_file_ && file() == File::kOwn) ::unlink(path_.c_str());
}

FileDescriptor UnixListener::accept() {
  const auto take = [this] {
    return FileDescriptor(::accept4(fd_.get(), nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC));
  };
  FileDescriptor client = take();
  if (!client.is_open() && (errno == EMFILE || errno == ENFILE)) {
    turned_away_.add(std::strerror(errno) + drivers::open_files_hint(errno), monotonic_ns());
    spare_ = FileDescriptor();
    take();
    spare_ = make_spare();
  }
  return client;
}

UnixListener::File UnixListener::file() const {
  struct stat file {};
  if (::stat(path_.c_str(), &file) != 0) {
    return errno == ENOENT || errno == ENOTDIR ? File::kRemoved : File::kOwn;
  }
  if (inode_ == 0) return File::kOwn;
  if (file.st_dev != device_ || file.st_ino != inode_) return File::kReplaced;
  return (file.st_mode & writers_) == writers_ ? File::kOwn : File::kClosed;
}

std::optional<bool> is_listening(const std::filesystem::path& file) {
  std::ifstream list("/proc/self/net/unix");
  std::string heading;
  if (!std::getline(list, heading)) return std::nullopt;
  return is_listening(file, list);
}

bool is_listening(const std::filesystem::path& file, std::istream& list) {
  for (std::string line; std::getline(list, line);) {
    // Num RefCount Protocol Flags Type St Inode Path
    std::istringstream words(line);
    std::string word;
    unsigned long flags = 0;
    words >> word >> word >> word >> std::hex >> flags >> word >> word >> word >> std::ws;
    std::string path;
    if (std::getline(words, path) && (flags & kListens) != 0 && is_same(file, path)) return true;
  }
  return false;
}

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
