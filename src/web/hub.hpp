// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <deque>
#include <functional>
#include <list>
#include <optional>
#include <string>
#include <string_view>

#include "client/subscription.hpp"
#include "message/request.hpp"
#include "web/outbox.hpp"

namespace cornerd::web {

/// The class of a line of the daemon, by its first key; nullopt for any other line.
std::optional<message::MessageClass> class_of(std::string_view line);

/// The daemon's messages: the last of each class, those of the last minute, and who waits for them.
/// For one thread.
class Hub {
 public:
  using Clock = std::chrono::steady_clock;

  /// A stream. `wake` is called when the outbox gets a message or the daemon comes or goes.
  struct Listener {
    message::ClassSet classes;
    std::function<void()> wake;
    Outbox outbox;
    bool connection_changed = true;
  };
  using Handle = std::list<Listener>::iterator;

  /// `text`: the message, or why the daemon is lost.
  void note(client::Event event, std::string_view text, Clock::time_point now);
  bool is_connected() const { return connected_; }
  /// Why the daemon cannot be reached.
  const std::string& problem() const { return problem_; }

  /// nullptr if there was none since the daemon was connected.
  Line last(message::MessageClass message_class) const {
    return last_[static_cast<std::size_t>(message_class)];
  }
  /// Lines with newlines that arrived in this time before `now`, after the map and the last STATUS:
  /// a recording for `replay` and `export`.
  std::string recording(std::chrono::seconds span, Clock::time_point now) const;

  /// The listener gets the last of each of its classes first.
  Handle add(const message::ClassSet& classes, std::function<void()> wake);
  void remove(Handle listener) { listeners_.erase(listener); }
  /// What a stream writes next, in the format of server-sent events; empty if nothing waits.
  std::string next_event(Listener& listener) const;
  std::size_t listeners() const { return listeners_.size(); }

 private:
  void take(std::string_view line, Clock::time_point now);
  void set_connected(bool connected, std::string_view problem);

  struct Kept {
    Clock::time_point at;
    Line line;
  };
  bool connected_ = false;
  std::string problem_ = "not connected yet";
  std::array<Line, message::kMessageClasses> last_;
  std::deque<Kept> kept_;
  std::size_t kept_bytes_ = 0;
  std::list<Listener> listeners_;
};

}  // namespace cornerd::web
