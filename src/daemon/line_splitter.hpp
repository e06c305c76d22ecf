// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace cornerd::daemon {

/// Splits a byte stream into lines. Skips empty lines and a carriage return before the newline.
class LineSplitter {
 public:
  explicit LineSplitter(std::size_t max_bytes) : max_bytes_(max_bytes) {}

  void feed(std::string_view bytes);
  /// The next line, valid until the next call of next() or feed(). nullopt if no line is complete
  /// or the next line is too long.
  std::optional<std::string_view> next();
  /// A complete line waits.
  bool has_line() const { return newline_ != std::string::npos; }
  /// The next line is too long; no further line can be read.
  bool is_too_long() const;

  /// The bytes after the last newline, at the end of the stream.
  std::string take_remainder();

 private:
  /// Of the next line, complete or not.
  std::size_t size() const { return (has_line() ? newline_ : bytes_.size()) - begin_; }
  void skip_empty();

  std::size_t max_bytes_;
  std::string bytes_;
  std::size_t begin_ = 0;  ///< start of the next line
  std::size_t newline_ = std::string::npos;
};

}  // namespace cornerd::daemon
