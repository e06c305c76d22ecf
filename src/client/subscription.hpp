// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <filesystem>
#include <string>
#include <string_view>

#include "client/connection.hpp"
#include "client/retry_delay.hpp"

namespace cornerd::client {

/// What Subscription::wait() gave.
enum class Event {
  kMessage,
  kConnected,
  kLost,  ///< the daemon is gone, or cannot be reached; problem() has the reason
  kTimeout
};

/// Messages of a daemon that may be absent, exit and return.
class Subscription {
 public:
  /// `request`: sent after each connect, such as WATCH with its newline; may be empty. The largest
  /// delay between two attempts to connect is `largest_delay`.
  Subscription(std::filesystem::path socket, std::string request,
               std::chrono::milliseconds largest_delay = std::chrono::seconds(2));

  /// Waits up to `timeout`, forever if it is negative. `line`: one message without its newline,
  /// valid until the next call. kLost comes once for each loss, and once at the start where nobody
  /// listens.
  Event wait(std::string_view& line, std::chrono::milliseconds timeout);
  Event wait(std::string_view& line) { return wait(line, std::chrono::milliseconds(-1)); }

  bool is_connected() const { return connection_.is_connected(); }
  const std::string& problem() const { return problem_; }

 private:
  using Clock = std::chrono::steady_clock;

  Event lose(std::string reason);
  bool connect_when_due(Clock::time_point now);

  std::filesystem::path socket_;
  std::string request_;
  RetryDelay delay_;
  Connection connection_;
  Clock::time_point next_try_{};
  bool loss_told_ = false;
  std::string problem_;
};

/// WATCH of these classes, with its newline: "POSE,SCAN" gives {"class":"WATCH","classes":[...]}.
std::string watch_request(std::string_view comma_separated_classes);

}  // namespace cornerd::client
