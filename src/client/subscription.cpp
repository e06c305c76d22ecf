// SPDX-License-Identifier: MIT
#include "client/subscription.hpp"

#include <algorithm>
#include <thread>
#include <utility>

namespace cornerd::client {

Subscription::Subscription(std::filesystem::path socket, std::string request,
                           std::chrono::milliseconds largest_delay)
    : socket_(std::move(socket)), request_(std::move(request)), delay_(largest_delay) {}

Event Subscription::lose(std::string reason) {
  connection_.close();
  problem_ = std::move(reason);
  next_try_ = Clock::now() + delay_.next();
  return Event::kLost;
}

bool Subscription::connect_when_due(Clock::time_point now) {
  if (now < next_try_) return false;
  if (connection_.connect(socket_, /*blocking=*/false) && connection_.send(request_)) return true;
  lose(connection_.problem());
  return false;
}

Event Subscription::wait(std::string_view& line, std::chrono::milliseconds timeout) {
  const Clock::time_point until = Clock::now() + timeout;
  for (;;) {
    const Clock::time_point now = Clock::now();
    auto left = std::chrono::ceil<std::chrono::milliseconds>(until - now);
    if (connection_.is_connected()) {
      const Received received =
          timeout.count() < 0
              ? connection_.receive(line)
              : connection_.receive(line, std::max(left, std::chrono::milliseconds(0)));
      if (received == Received::kNothing) return Event::kTimeout;
      if (received == Received::kEnd) {
        loss_told_ = true;
        return lose(socket_.string() + ": the daemon closed the connection");
      }
      delay_.reset();
      return Event::kMessage;
    }
    if (connect_when_due(now)) {
      loss_told_ = false;
      return Event::kConnected;
    }
    if (!std::exchange(loss_told_, true)) return Event::kLost;
    if (timeout.count() >= 0 && left.count() <= 0) return Event::kTimeout;
    auto pause = std::chrono::ceil<std::chrono::milliseconds>(next_try_ - Clock::now());
    if (timeout.count() >= 0) pause = std::min(pause, left);
    std::this_thread::sleep_for(pause);
  }
}

std::string watch_request(std::string_view comma_separated_classes) {
  std::string request = R"({"class":"WATCH","classes":[")";
  for (const char c : comma_separated_classes) {
    if (c == ',') {
      request += R"(",")";
    } else {
      request += c;
    }
  }
  return request + "\"]}\n";
}

}  // namespace cornerd::client
