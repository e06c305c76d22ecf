// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>

namespace cornerd::replay {

/// A pseudo-terminal: a software serial port that any program can open at path(). Not safe for
/// concurrent calls.
class PseudoTerminal {
 public:
  /// `link`: symbolic link to create; empty: none. Replaces an existing link, but no other file.
  /// `baud`: for clients that set none. Throws std::system_error.
  explicit PseudoTerminal(const std::filesystem::path& link = {}, std::uint32_t baud = 115200);
  ~PseudoTerminal();
  PseudoTerminal(const PseudoTerminal&) = delete;
  PseudoTerminal& operator=(const PseudoTerminal&) = delete;

  const std::filesystem::path& path() const { return path_; }

  /// Waits for bytes or the timeout. True if a client has the port open.
  bool wait(int timeout_ms);

  /// Whether the client has set this speed; true if termios does not know it.
  bool has_speed(std::uint32_t baud) const;

  /// Number of bytes read from the client.
  std::size_t read(std::span<std::uint8_t> buffer);

  /// Number of bytes that the client's buffer had room for; the rest are lost.
  std::size_t write(std::span<const std::uint8_t> bytes);

 private:
  bool prepare_for_next_client();

  int master_ = -1;
  std::filesystem::path path_;
  std::filesystem::path link_;
  std::uint32_t baud_;
  bool has_client_ = true;
};

}  // namespace cornerd::replay
