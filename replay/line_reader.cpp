// SPDX-License-Identifier: MIT
#include "replay/line_reader.hpp"

namespace cornerd::replay {

LineReader::Result LineReader::next() {
  line_.clear();
  std::streambuf* const buffer = stream_.rdbuf();
  bool too_long = false;
  bool any = false;
  for (int c = buffer->sbumpc(); c != std::char_traits<char>::eof(); c = buffer->sbumpc()) {
    if (!any) ++number_;
    any = true;
    if (c == '\n') {
      if (!line_.empty() && line_.back() == '\r') line_.pop_back();
      return too_long ? Result::kTooLong : Result::kLine;
    }
    if (too_long) continue;
    if (line_.size() == max_chars_) {
      too_long = true;
      line_.clear();
      continue;
    }
    line_.push_back(static_cast<char>(c));
  }
  stream_.setstate(std::ios::eofbit);
  if (!any) return Result::kEnd;
  return too_long ? Result::kTooLong : Result::kTornLine;
}

}  // namespace cornerd::replay
