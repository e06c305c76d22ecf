// SPDX-License-Identifier: MIT
#include "daemon/line_splitter.hpp"

namespace cornerd::daemon {

void LineSplitter::feed(std::string_view bytes) {
  bytes_.erase(0, begin_);
  if (has_line()) newline_ -= begin_;
  begin_ = 0;
  const std::size_t fresh = bytes_.size();
  bytes_ += bytes;
  if (!has_line()) newline_ = bytes_.find('\n', fresh);
  skip_empty();
}

void LineSplitter::skip_empty() {
  while (has_line() && (size() == 0 || (size() == 1 && bytes_[begin_] == '\r'))) {
    begin_ = newline_ + 1;
    newline_ = bytes_.find('\n', begin_);
  }
}

std::optional<std::string_view> LineSplitter::next() {
  if (!has_line() || is_too_long()) return std::nullopt;
  std::string_view line = std::string_view(bytes_).substr(begin_, size());
  if (line.ends_with('\r')) line.remove_suffix(1);
  begin_ = newline_ + 1;
  newline_ = bytes_.find('\n', begin_);
  skip_empty();
  return line;
}

bool LineSplitter::is_too_long() const { return size() > max_bytes_; }

std::string LineSplitter::take_remainder() {
  std::string rest = bytes_.substr(begin_);
  bytes_.clear();
  begin_ = 0;
  newline_ = std::string::npos;
  return rest;
}

}  // namespace cornerd::daemon
