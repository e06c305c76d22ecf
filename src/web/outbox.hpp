// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <memory>
#include <string>

#include "message/request.hpp"

namespace cornerd::web {

/// One line of the daemon without its newline, shared by all who wait for it.
using Line = std::shared_ptr<const std::string>;

/// What one stream has not read yet: of each class the newest few. A slow reader loses its own old
/// messages and is told how many.
class Outbox {
 public:
  void offer(message::MessageClass message_class, Line line);
  bool empty() const { return waiting_.empty(); }
  /// What a daemon said that is gone may be wrong; its map is still the picture to show.
  void forget_all_but_map();
  /// The oldest, with "dropped":n if older ones of its class were lost.
  std::string take();

 private:
  struct Entry {
    message::MessageClass message_class;
    Line line;
  };
  std::deque<Entry> waiting_;
  std::array<std::uint64_t, message::kMessageClasses> dropped_{};
};

}  // namespace cornerd::web
