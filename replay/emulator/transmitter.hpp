// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <vector>

#include "core/types.hpp"
#include "replay/simulator/serial_line.hpp"

namespace cornerd::replay {

/// What the device has to say, at the pace of its serial line.
class Transmitter {
 public:
  explicit Transmitter(std::uint32_t baud) : line_(baud) {}

  /// Queues bytes that may be sent from `ready_ns` on.
  void queue(core::TimeNs ready_ns, std::span<const std::uint8_t> bytes);

  /// Drops what has not begun to be sent by `now_ns`. What has begun is sent to its end.
  void drop_unsent(core::TimeNs now_ns);
  /// The device falls silent in the middle of a byte.
  void clear(core::TimeNs now_ns);

  /// Appends the bytes that have crossed the line by `now_ns`.
  void take(core::TimeNs now_ns, std::vector<std::uint8_t>& out);

  /// When the next byte will have crossed; nullopt where there is none.
  std::optional<core::TimeNs> next_ns() const;

 private:
  struct Chunk {
    core::TimeNs start_ns = 0;
    std::vector<std::uint8_t> bytes;
    std::size_t sent = 0;
  };
  core::TimeNs crossed_ns(const Chunk& chunk) const {
    return chunk.start_ns + line_.duration_ns(chunk.sent + 1);
  }

  SerialLine line_;
  std::deque<Chunk> chunks_;
};

}  // namespace cornerd::replay
