// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <string>
#include <string_view>

#include "message/request.hpp"

namespace cornerd::daemon {

/// What one client has yet to get. Of each class it holds the newest line alone: a client that does
/// not read loses its own older messages and is told how many, and costs nobody memory or time. A
/// line that was begun is finished before any other.
class Outbox {
 public:
  /// Takes some of the bytes and says how many; 0: not now; negative: never again.
  using Write = std::function<std::ptrdiff_t(std::string_view bytes)>;
  enum class Result : std::uint8_t {
    kEmpty,    ///< all is written
    kBlocked,  ///< the rest waits until the client reads
    kBroken,
  };

  /// A message: replaces the one of its class that still waits.
  void put(message::MessageClass message_class, std::string_view line);
  /// An answer to the client's own request: kept, in order.
  void answer(std::string_view line);

  Result flush(const Write& write);

  std::size_t waiting_answers() const { return answers_.size(); }
  /// Lines that were replaced, of all classes.
  std::uint64_t dropped() const { return dropped_; }

 private:
  struct Slot {
    std::string line;  ///< empty: nothing waits
    std::uint64_t order = 0;
    std::uint64_t dropped = 0;  ///< since the last line of this class that was delivered
  };
  static constexpr std::size_t kClasses =
      static_cast<std::size_t>(message::MessageClass::kEvent) + 1;

  Slot* oldest();
  Result write_line(std::string_view line, const Write& write);

  std::string partial_;  ///< rest of a line that was begun
  std::deque<std::string> answers_;
  std::array<Slot, kClasses> slots_;
  std::uint64_t order_ = 0;
  std::uint64_t dropped_ = 0;
};

}  // namespace cornerd::daemon
