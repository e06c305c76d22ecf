// SPDX-License-Identifier: MIT
#include "daemon/systemd.hpp"

#include <fcntl.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <charconv>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <string>
#include <utility>

namespace cornerd::daemon {
namespace {

/// SD_LISTEN_FDS_START.
constexpr int kFirstSocket = 3;
/// A larger $LISTEN_FDS is taken for wrong, so that it closes no other descriptors.
constexpr std::uint64_t kMaxSockets = 16;

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
  // A path of maximum length is not null-terminated.
  return is_unix
             ? std::string(address.sun_path, ::strnlen(address.sun_path, sizeof(address.sun_path)))
             : std::string();
}

/// A decimal number; nullopt if the variable is not set or holds anything else.
std::optional<std::uint64_t> number_in_environment(const char* name) {
  const char* text = std::getenv(name);
  if (text == nullptr) return std::nullopt;
  std::uint64_t number = 0;
  const char* end = text + std::strlen(text);
  const auto result = std::from_chars(text, end, number);
  if (result.ec != std::errc() || result.ptr != end) return std::nullopt;
  return number;
}

}  // namespace

std::vector<InheritedSocket> take_inherited_sockets() {
  std::vector<InheritedSocket> sockets;
  const auto pid = number_in_environment("LISTEN_PID");
  const auto count = number_in_environment("LISTEN_FDS");
  for (const char* name : {"LISTEN_PID", "LISTEN_FDS", "LISTEN_FDNAMES"}) ::unsetenv(name);
  if (pid != static_cast<std::uint64_t>(::getpid()) || !count || *count > kMaxSockets)
    return sockets;
  for (int fd = kFirstSocket; fd < kFirstSocket + static_cast<int>(*count); ++fd) {
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

Notifier::Notifier() {
  const char* address = std::getenv("NOTIFY_SOCKET");
  if (address != nullptr) address_ = address;
  const bool is_address = address_.size() > 1 && (address_[0] == '/' || address_[0] == '@') &&
                          address_.size() < sizeof(sockaddr_un::sun_path);
  if (!is_address) return;
  socket_ = FileDescriptor(::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0));

  const auto watchdog_us = number_in_environment("WATCHDOG_USEC");
  const auto watched_pid = number_in_environment("WATCHDOG_PID");
  const bool watches_us = !watched_pid || *watched_pid == static_cast<std::uint64_t>(::getpid());
  if (watchdog_us && *watchdog_us >= 2 && watches_us) watchdog_period_us_ = *watchdog_us / 2;
}

void Notifier::status(std::string_view text) {
  if (text == status_) return;
  status_ = text;
  send("STATUS=" + status_);
}

void Notifier::send(std::string_view state) {
  if (!socket_.is_open()) return;
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  std::memcpy(address.sun_path, address_.data(), address_.size());
  if (address.sun_path[0] == '@') address.sun_path[0] = '\0';  // an abstract address
  const auto length = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + address_.size());
  // Errors are ignored: the daemon works without a service manager.
  static_cast<void>(::sendto(socket_.get(), state.data(), state.size(), MSG_NOSIGNAL | MSG_DONTWAIT,
                             reinterpret_cast<const sockaddr*>(&address), length));
}

}  // namespace cornerd::daemon
