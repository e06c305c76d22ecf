// SPDX-License-Identifier: MIT
#pragma once

#include <termios.h>

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace cornerd::tool {

/// The terminal of standard output: a screen of its own and single keys, and everything as it was
/// at the end. Never waits: a terminal that takes nothing, as that of a broken ssh, stops nobody.
class Terminal {
 public:
  /// Throws Failure where standard output is no terminal.
  Terminal();
  ~Terminal();
  Terminal(const Terminal&) = delete;
  Terminal& operator=(const Terminal&) = delete;

  int fd() const { return fd_; }
  struct Size {
    std::size_t columns = 80;
    std::size_t rows = 24;
  };
  Size size() const;

  /// Keys since the last call; nullopt: it has hung up.
  std::optional<std::string> take_keys();

  /// Writes as much as it takes; the rest when flush() is called. False: it has hung up.
  bool show(std::string_view bytes);
  bool flush();
  bool has_unsent() const { return !unsent_.empty(); }

  /// Gives screen and keys back, and takes them again: around a stop of the process.
  void leave();
  void enter();

 private:
  int fd_ = -1;
  termios before_{};
  std::string unsent_;
};

/// The keys of what came from a terminal: without the sequences that arrows and the like send.
std::string plain_keys(std::string_view bytes);

}  // namespace cornerd::tool
