// SPDX-License-Identifier: MIT
#pragma once

#include <poll.h>
#include <sys/socket.h>
#include <sys/un.h>

#include <cstring>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "daemon/require_fd.hpp"

namespace cornerd::daemon {

/// A client for tests: connects, writes lines, reads lines.
class TestClient {
 public:
  explicit TestClient(const std::filesystem::path& path)
      : fd_(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    std::strncpy(address.sun_path, path.c_str(), sizeof(address.sun_path) - 1);
    connected_ =
        ::connect(fd_.get(), reinterpret_cast<const sockaddr*>(&address), sizeof(address)) == 0;
  }

  bool is_connected() const { return connected_; }

  bool send(std::string_view text) {
    while (!text.empty()) {
      const ssize_t sent = ::send(fd_.get(), text.data(), text.size(), MSG_NOSIGNAL);
      if (sent <= 0) return false;
      text.remove_prefix(static_cast<std::size_t>(sent));
    }
    return true;
  }

  /// Sends what fits into the socket's buffer.
  void offer(std::string_view text) {
    static_cast<void>(::send(fd_.get(), text.data(), text.size(), MSG_NOSIGNAL | MSG_DONTWAIT));
  }

  void finish_sending() { ::shutdown(fd_.get(), SHUT_WR); }

  /// The next line without its newline; nullopt after the timeout or the end of the connection.
  std::optional<std::string> read_line(int timeout_ms = 10'000) {
    while (true) {
      const std::size_t newline = buffer_.find('\n');
      if (newline != std::string::npos) {
        std::string line = buffer_.substr(0, newline);
        buffer_.erase(0, newline + 1);
        return line;
      }
      pollfd readable{fd_.get(), POLLIN, 0};
      if (::poll(&readable, 1, timeout_ms) <= 0) return std::nullopt;
      char block[4096];
      const ssize_t count = ::recv(fd_.get(), block, sizeof(block), 0);
      if (count <= 0) {
        ended_ = true;
        return std::nullopt;
      }
      buffer_.append(block, static_cast<std::size_t>(count));
    }
  }

  /// The other side closed the connection. Valid after read_line().
  bool has_ended() const { return ended_; }

 private:
  FileDescriptor fd_;
  bool connected_ = false;
  bool ended_ = false;
  std::string buffer_;
};

}  // namespace cornerd::daemon
