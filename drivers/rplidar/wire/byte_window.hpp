// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "drivers/rplidar/decoder.hpp"
#include "drivers/rplidar/protocol/framing.hpp"

namespace cornerd::rplidar {

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

  std::array<std::uint8_t, 1024> bytes_;  ///< no decision needs more than 150
  std::size_t begin_ = 0;
  std::size_t end_ = 0;
};

/// Whether the next bytes are a packet.
enum class Verdict : std::uint8_t {
  kNo,
  kYes,
  kMore,  ///< undecided: needs more bytes
};

/// What a format's decoder made of the next bytes.
enum class Step : std::uint8_t {
  kMore,      ///< needs more bytes
  kProgress,  ///< consumed bytes
  kLost,      ///< no packet of the format follows: search for one
};

struct DescriptorMatch {
  Verdict verdict = Verdict::kNo;
  /// nullopt: a format that no A1 sends (dense, HQ), whose packets resemble capsules.
  std::optional<WireFormat> format;
};

/// Whether `bytes` begin with the response descriptor of a scan, all 7 bytes of it.
DescriptorMatch match_scan_descriptor(std::span<const std::uint8_t> bytes);

}  // namespace cornerd::rplidar
