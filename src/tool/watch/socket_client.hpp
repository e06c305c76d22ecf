// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>
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

  /// False where nobody listens there; problem() and error_number() say why. Not `patient`: where
  /// somebody listens and too many wait before us, too.
  bool connect(const std::filesystem::path& socket, bool blocking = true);
  void close();

  /// False where the daemon has gone.
  bool send(std::string_view line);

  /// Waits for more of what the daemon says: one or more whole lines, each with its newline, valid
  /// until the next call. Empty: the daemon has gone; a line that it did not end is dropped.
  std::string_view receive();

  /// What is there of it already: whole lines, or none. nullopt: the daemon has gone.
  std::optional<std::string_view> take();

  /// To wait for what it says; -1 where it is not connected.
  int fd() const { return fd_; }

  const std::string& problem() const { return problem_; }
  int error_number() const { return error_number_; }

 private:
  bool fail(const std::string& path, int error_number);
  /// One read, as recv() has the flags; false where the daemon has gone.
  bool fetch(int flags);
  /// Hands out the whole lines that are there.
  std::string_view whole_lines();

  int fd_ = -1;
  std::string buffer_;
  std::size_t handed_out_ = 0;
  int error_number_ = 0;
  std::string problem_;
};

}  // namespace cornerd::tool
