// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace cornerd::daemon {

/// Cuts a stream of bytes into lines. Empty ones are passed over, as is a carriage return before
/// the newline.
class LineSplitter {
 public:
  explicit LineSplitter(std::size_t max_bytes) : max_bytes_(max_bytes) {}

  void feed(std::string_view bytes);
  /// The next line, until the next call of this or feed(). Nothing: no line is complete, or the
  /// next one is longer than allowed.
  std::optional<std::string_view> next();
  /// There is a line that next() has not given yet.
  bool has_line() const { return newline_ != std::string::npos; }
  /// The next line is longer than allowed: no more of the stream can be understood.
  bool is_too_long() const;

  /// What came after the last newline; the stream has ended.
  std::string take_remainder();

 private:
  /// Of the next line, or of the part of it that is there.
  std::size_t size() const { return (has_line() ? newline_ : bytes_.size()) - begin_; }
  void skip_empty();

  std::size_t max_bytes_;
  std::string bytes_;
  std::size_t begin_ = 0;  ///< of the next line
  std::size_t newline_ = std::string::npos;
};

}  // namespace cornerd::daemon
