// SPDX-License-Identifier: MIT
#include "daemon/inherited_sockets.hpp"

#include <fcntl.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <string>
#include <utility>

#include "daemon/environment.hpp"

namespace cornerd::daemon {
namespace {

constexpr int kFirst = 3;
/// No unit passes more; a wrong number is not to close the descriptors of others.
constexpr std::uint64_t kMost = 16;

int option(int fd, int name) {
  int value = -1;
  socklen_t size = sizeof(value);
  return ::getsockopt(fd, SOL_SOCKET, name, &value, &size) == 0 ? value : -1;
}

std::filesystem::path path_of(int fd) {
  sockaddr_un address{};
  socklen_t size = sizeof(address);
  const bool is_unix = ::getsockname(fd, reinterpret_cast<sockaddr*>(&address), &size) == 0 &&
                       address.sun_family == AF_UNIX;
  // The longest path has no zero at its end.
  return is_unix
             ? std::string(address.sun_path, ::strnlen(address.sun_path, sizeof(address.sun_path)))
             : std::string();
}

}  // namespace

std::vector<InheritedSocket> take_inherited_sockets() {
  std::vector<InheritedSocket> sockets;
  const auto pid = number_in_environment("LISTEN_PID");
  const auto count = number_in_environment("LISTEN_FDS");
  for (const char* name : {"LISTEN_PID", "LISTEN_FDS", "LISTEN_FDNAMES"}) ::unsetenv(name);
  if (pid != static_cast<std::uint64_t>(::getpid()) || !count || *count > kMost) return sockets;
  for (int fd = kFirst; fd < kFirst + static_cast<int>(*count); ++fd) {
    FileDescriptor owned(fd);
    ::fcntl(fd, F_SETFD, FD_CLOEXEC);
    if (option(fd, SO_ACCEPTCONN) != 1 || option(fd, SO_TYPE) != SOCK_STREAM) continue;
    std::filesystem::path path = path_of(fd);
    if (path.empty()) continue;
    ::fcntl(fd, F_SETFL, ::fcntl(fd, F_GETFL) | O_NONBLOCK);
    sockets.push_back({std::move(path), std::move(owned)});
  }
  return sockets;
}

}  // namespace cornerd::daemon
