// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace cornerd::drivers {

/// Received bytes that are not yet decoded or skipped. A decoder consumes them only when it is
/// sure, so that a false packet boundary can be searched again.
class ByteWindow {
 public:
  /// Returns how many bytes there was room for.
  std::size_t append(std::span<const std::uint8_t> bytes) {
    if (end_ + bytes.size() > bytes_.size()) close_up();
    const std::size_t count = std::min(bytes.size(), bytes_.size() - end_);
    std::copy_n(bytes.begin(), count, bytes_.begin() + static_cast<std::ptrdiff_t>(end_));
    end_ += count;
    return count;
  }

  std::span<const std::uint8_t> unread() const { return {bytes_.data() + begin_, end_ - begin_}; }

  void consume(std::size_t count) { begin_ += std::min(count, end_ - begin_); }

 private:
  void close_up() {
    std::copy(bytes_.begin() + static_cast<std::ptrdiff_t>(begin_),
              bytes_.begin() + static_cast<std::ptrdiff_t>(end_), bytes_.begin());
    end_ -= begin_;
    begin_ = 0;
  }

  std::array<std::uint8_t, 1024> bytes_;  ///< no decision needs more than 783, of an HQ packet
  std::size_t begin_ = 0;
  std::size_t end_ = 0;
};

}  // namespace cornerd::drivers
