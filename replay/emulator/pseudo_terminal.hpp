// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>

namespace cornerd::replay {

/// A serial port made of software: what it is written to comes out at `path()`, which any program
/// can open as it opens a port, and the other way round. Not safe for concurrent calls.
class PseudoTerminal {
 public:
  /// `link`: a symbolic link to make to it; empty: none. One that exists is replaced, but nothing
  /// that is not a link. Throws std::system_error.
  explicit PseudoTerminal(const std::filesystem::path& link = {});
  ~PseudoTerminal();
  PseudoTerminal(const PseudoTerminal&) = delete;
  PseudoTerminal& operator=(const PseudoTerminal&) = delete;

  const std::filesystem::path& path() const { return path_; }

  /// Waits until there is something to read, or that time has passed. True where a client has the
  /// port open.
  bool wait(int timeout_ms);

  /// Whether the client has set that speed; true for one that termios does not know.
  bool has_speed(std::uint32_t baud) const;

  /// Bytes that the client has written; 0 where there are none.
  std::size_t read(std::span<std::uint8_t> buffer);

  /// Returns the bytes that the client's side had room for: a port without flow control loses the
  /// rest.
  std::size_t write(std::span<const std::uint8_t> bytes);

 private:
  bool prepare_for_next_client();

  int master_ = -1;
  std::filesystem::path path_;
  std::filesystem::path link_;
  bool has_client_ = true;
};

}  // namespace cornerd::replay
