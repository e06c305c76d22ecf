// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <istream>
#include <string>
#include <string_view>

namespace cornerd::replay {

/// Reads lines with a limit on their length.
class LineReader {
 public:
  enum class Result : std::uint8_t {
    kLine,
    kTornLine,  ///< the last line, without a newline
    kTooLong,   ///< skipped; line() is empty
    kEnd,
  };

  LineReader(std::istream& stream, std::size_t max_chars)
      : stream_(stream), max_chars_(max_chars) {}

  Result next();

  /// Without line end; valid until the next call.
  std::string_view line() const { return line_; }
  /// Number of the last line; the first is 1.
  std::uint64_t number() const { return number_; }

 private:
  std::istream& stream_;
  std::size_t max_chars_;
  std::string line_;
  std::uint64_t number_ = 0;
};

}  // namespace cornerd::replay
