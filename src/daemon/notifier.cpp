// SPDX-License-Identifier: MIT
#include "daemon/notifier.hpp"

#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <cstddef>
#include <cstdlib>
#include <cstring>

#include "daemon/environment.hpp"

namespace cornerd::daemon {
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
  // A manager that does not listen is its own affair.
  static_cast<void>(::sendto(socket_.get(), state.data(), state.size(), MSG_NOSIGNAL | MSG_DONTWAIT,
                             reinterpret_cast<const sockaddr*>(&address), length));
}

}  // namespace cornerd::daemon
