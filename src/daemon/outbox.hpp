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

/// The lines that wait for one client: answers in order, and the newest message of each class. A
/// slow client loses older messages; "dropped" in the next one gives their number. A partly written
/// line is finished before any other.
class Outbox {
 public:
  /// Returns the number of bytes written; 0 if writing would block; negative if the connection is
  /// broken.
  using Write = std::function<std::ptrdiff_t(std::string_view bytes)>;
  enum class Result : std::uint8_t {
    kEmpty,    ///< everything is written
    kBlocked,  ///< the client has to read first
    kBroken,
  };

  /// Replaces the waiting message of the same class.
  void put(message::MessageClass message_class, std::string_view line);
  /// Answers are never dropped.
  void answer(std::string_view line);

  Result flush(const Write& write);

  std::size_t waiting_answers() const { return answers_.size(); }
  /// Messages replaced, of all classes.
  std::uint64_t dropped() const { return dropped_; }

 private:
  struct Slot {
    std::string line;  ///< empty if none waits
    std::uint64_t order = 0;
    std::uint64_t dropped = 0;  ///< since the last delivered line of this class
  };
  static constexpr std::size_t kClasses =
      static_cast<std::size_t>(message::MessageClass::kEvent) + 1;

  Slot* oldest();
  Result write_line(std::string_view line, const Write& write);

  std::string partial_;  ///< rest of a partly written line
  std::deque<std::string> answers_;
  std::array<Slot, kClasses> slots_;
  std::uint64_t order_ = 0;
  std::uint64_t dropped_ = 0;
};

}  // namespace cornerd::daemon
