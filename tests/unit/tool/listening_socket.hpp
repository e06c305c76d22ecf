// SPDX-License-Identifier: MIT
#pragma once

#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <filesystem>
#include <stdexcept>
#include <string_view>

namespace cornerd::tool {

/// The daemon's end of a socket, for a test to play.
class ListeningSocket {
 public:
  explicit ListeningSocket(const std::filesystem::path& path)
      : fd_(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    path.native().copy(address.sun_path, sizeof address.sun_path - 1);
    const auto* const any = reinterpret_cast<const sockaddr*>(&address);
    if (::bind(fd_, any, sizeof address) != 0 || ::listen(fd_, 4) != 0) {
      throw std::runtime_error(path.string() + ": cannot listen there");
    }
  }
  ~ListeningSocket() { ::close(fd_); }
  ListeningSocket(const ListeningSocket&) = delete;
  ListeningSocket& operator=(const ListeningSocket&) = delete;

  /// Waits for a client; the descriptor is the caller's.
  int accept() const { return ::accept4(fd_, nullptr, nullptr, SOCK_CLOEXEC); }
  /// One client's whole visit.
  void accept_and_send(std::string_view text) const {
    const int client = accept();
    static_cast<void>(::send(client, text.data(), text.size(), MSG_NOSIGNAL));
    ::close(client);
  }

 private:
  int fd_ = -1;
};

}  // namespace cornerd::tool
