// SPDX-License-Identifier: MIT
#pragma once

#include <termios.h>

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace cornerd::tool {

/// The terminal of standard output in raw mode on the alternate screen; the destructor restores it.
/// Never blocks, even if the terminal accepts no output (a broken ssh).
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

  /// Keys since the last call; nullopt: the terminal hung up.
  std::optional<std::string> take_keys();

  /// Writes what the terminal accepts; flush() writes the rest. False: the terminal hung up.
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

/// The single keys in a terminal's input, without the sequences of arrow and function keys.
std::string plain_keys(std::string_view bytes);

}  // namespace cornerd::tool
