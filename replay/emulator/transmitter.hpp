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

/// Send queue of the device, at the speed of its serial line.
class Transmitter {
 public:
  explicit Transmitter(std::uint32_t baud) : line_(baud) {}

  /// Queues bytes, to be sent from `ready_ns` on.
  void queue(core::TimeNs ready_ns, std::span<const std::uint8_t> bytes);

  /// Drops packets whose transmission has not begun by `now_ns`.
  void drop_unsent(core::TimeNs now_ns);
  /// Drops everything, even a packet in transmission.
  void clear(core::TimeNs now_ns);

  /// Appends the bytes that have arrived by `now_ns`.
  void take(core::TimeNs now_ns, std::vector<std::uint8_t>& out);

  /// Arrival of the next byte; nullopt if there is none.
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
