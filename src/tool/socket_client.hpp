// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace cornerd::tool {

/// The client's end of one of the daemon's sockets: whole lines in and out.
class SocketClient {
 public:
  SocketClient() = default;
  ~SocketClient();
  SocketClient(const SocketClient&) = delete;
  SocketClient& operator=(const SocketClient&) = delete;

  /// False where nobody listens there; problem() says why.
  bool connect(const std::filesystem::path& socket);
  void close();

  /// False where the daemon has gone.
  bool send(std::string_view line);

  /// Waits for more of what the daemon says: one or more whole lines, each with its newline, valid
  /// until the next call. Empty: the daemon has gone; a line that it did not end is dropped.
  std::string_view receive();

  const std::string& problem() const { return problem_; }

 private:
  int fd_ = -1;
  std::string buffer_;
  std::size_t handed_out_ = 0;
  std::string problem_;
};

}  // namespace cornerd::tool
