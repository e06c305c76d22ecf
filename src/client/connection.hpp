// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace cornerd::client {

/// What a read gave.
enum class Received {
  kLine,     ///< one message
  kNothing,  ///< no complete line yet
  kEnd       ///< the daemon closed the connection; an incomplete line is dropped
};

/// A client's end of one of the daemon's sockets: one message at a time. Allocates only for a line
/// that is longer than each before it.
class Connection {
 public:
  Connection() = default;
  ~Connection();
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;

  /// False on failure; see problem() and error_number(). Not `blocking`: fails also if the queue of
  /// pending connections is full.
  bool connect(const std::filesystem::path& socket, bool blocking = true);
  void close();
  bool is_connected() const { return fd_ >= 0; }

  /// `line`: with its newline. False if the daemon closed the connection.
  bool send(std::string_view line);

  /// The next line without its newline, valid until the next call. Never waits.
  Received take(std::string_view& line);
  /// The same; waits up to `timeout` for a line, forever if it is negative.
  Received receive(std::string_view& line, std::chrono::milliseconds timeout);
  Received receive(std::string_view& line) { return receive(line, std::chrono::milliseconds(-1)); }

  /// For poll(); -1 if not connected. Readable: call take() until it gives no line.
  int fd() const { return fd_; }

  const std::string& problem() const { return problem_; }
  int error_number() const { return error_number_; }

 private:
  bool fail(const std::string& path, int error_number);
  bool next_line(std::string_view& line);
  void make_room();

  int fd_ = -1;
  std::vector<char> buffer_;
  std::size_t begin_ = 0;     ///< of what is not handed out
  std::size_t searched_ = 0;  ///< no newline from begin_ up to here
  std::size_t end_ = 0;
  int error_number_ = 0;
  std::string problem_;
};

}  // namespace cornerd::client
