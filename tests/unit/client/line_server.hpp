// SPDX-License-Identifier: MIT
#pragma once

#include <poll.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <cstring>
#include <filesystem>
#include <string>
#include <string_view>

namespace cornerd::client {

/// The daemon's side of a socket, in the hands of a test.
class LineServer {
 public:
  explicit LineServer(const std::filesystem::path& path) : path_(path) {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    std::strncpy(address.sun_path, path.c_str(), sizeof address.sun_path - 1);
    listener_ = ::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
    ::bind(listener_, reinterpret_cast<const sockaddr*>(&address), sizeof address);
    ::listen(listener_, 4);
  }
  ~LineServer() {
    hang_up();
    ::close(listener_);
    std::filesystem::remove(path_);
  }
  LineServer(const LineServer&) = delete;
  LineServer& operator=(const LineServer&) = delete;

  /// Waits for a client, at most a minute.
  bool accept() {
    pollfd entry{.fd = listener_, .events = POLLIN, .revents = 0};
    if (::poll(&entry, 1, 60'000) > 0) client_ = ::accept(listener_, nullptr, nullptr);
    return client_ >= 0;
  }
  void hang_up() {
    if (client_ >= 0) ::close(client_);
    client_ = -1;
  }
  void write(std::string_view text) {
    while (!text.empty()) {
      const ssize_t sent = ::send(client_, text.data(), text.size(), MSG_NOSIGNAL);
      if (sent <= 0) return;
      text.remove_prefix(static_cast<std::size_t>(sent));
    }
  }
  /// The client's next line with its newline; what came of it at the end of the connection.
  std::string read_line() {
    std::string line;
    for (char c = 0; c != '\n' && ::recv(client_, &c, 1, 0) == 1;) line += c;
    return line;
  }

 private:
  std::filesystem::path path_;
  int listener_ = -1;
  int client_ = -1;
};

}  // namespace cornerd::client
