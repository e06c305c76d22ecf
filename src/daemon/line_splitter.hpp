// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <utility>

namespace cornerd::daemon {

/// Cuts a stream of bytes into lines. Empty ones are passed over, as is a carriage return before
/// the newline.
class LineSplitter {
 public:
  explicit LineSplitter(std::size_t max_bytes) : max_bytes_(max_bytes) {}

  /// False where a line is longer than allowed: no more of the stream can be understood.
  [[nodiscard]] bool feed(std::string_view bytes,
                          const std::function<void(std::string_view line)>& handle);

  /// What came after the last newline; the stream has ended.
  std::string take_rest() { return std::exchange(rest_, {}); }

 private:
  std::size_t max_bytes_;
  std::string rest_;
};

}  // namespace cornerd::daemon
