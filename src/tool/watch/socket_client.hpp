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

  /// False on failure; see problem() and error_number(). Not `blocking`: fails also if the queue of
  /// pending connections is full.
  bool connect(const std::filesystem::path& socket, bool blocking = true);
  void close();

  /// False if the daemon closed the connection.
  bool send(std::string_view line);

  /// Waits for one or more complete lines with their newlines, valid until the next call. Empty:
  /// the daemon closed the connection; an incomplete line is dropped.
  std::string_view receive();

  /// Complete lines that have arrived, or none. nullopt: the daemon closed the connection.
  std::optional<std::string_view> take();

  /// For poll(); -1 if not connected.
  int fd() const { return fd_; }

  const std::string& problem() const { return problem_; }
  int error_number() const { return error_number_; }

 private:
  bool fail(const std::string& path, int error_number);
  /// One recv() with these flags; false if the daemon closed the connection.
  bool fetch(int flags);
  /// The complete lines in the buffer.
  std::string_view whole_lines();

  int fd_ = -1;
  std::string buffer_;
  std::size_t handed_out_ = 0;
  std::size_t lines_end_ = 0;  ///< of the complete lines
  int error_number_ = 0;
  std::string problem_;
};

}  // namespace cornerd::tool
