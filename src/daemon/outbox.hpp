// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include "message/request.hpp"

namespace cornerd::daemon {

/// A line with its newline. Clients share it: a MAP may have megabytes.
using Line = std::shared_ptr<const std::string>;

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
  void put(message::MessageClass message_class, Line line);
  /// Answers are never dropped.
  void answer(Line line) { answers_.push_back(std::move(line)); }
  void answer(std::string_view line) { answer(std::make_shared<const std::string>(line)); }

  Result flush(const Write& write);

  std::size_t waiting_answers() const { return answers_.size(); }
  /// Messages replaced, of all classes.
  std::uint64_t dropped() const { return dropped_; }

 private:
  struct Slot {
    Line line;  ///< null if none waits
    std::uint64_t order = 0;
    std::uint64_t dropped = 0;  ///< since the last delivered line of this class
  };

  Slot* oldest();
  /// The next line to begin; null if none waits.
  Line next();
  void remove_next();

  Line partial_;             ///< a partly written line, or null
  std::size_t written_ = 0;  ///< bytes of it
  std::deque<Line> answers_;
  std::array<Slot, message::kMessageClasses> slots_;
  std::uint64_t order_ = 0;
  std::uint64_t dropped_ = 0;
};

}  // namespace cornerd::daemon
