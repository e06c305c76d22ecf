// SPDX-License-Identifier: MIT
#include "daemon/line_splitter.hpp"

namespace cornerd::daemon {

bool LineSplitter::feed(std::string_view bytes,
                        const std::function<void(std::string_view line)>& handle) {
  while (true) {
    const std::size_t newline = bytes.find('\n');
    const std::string_view piece = bytes.substr(0, newline);
    if (rest_.size() + piece.size() > max_bytes_) return false;
    rest_ += piece;
    if (newline == std::string_view::npos) return true;
    bytes.remove_prefix(newline + 1);
    std::string line = take_rest();
    if (line.ends_with('\r')) line.pop_back();
    if (!line.empty()) handle(line);
  }
}

}  // namespace cornerd::daemon
