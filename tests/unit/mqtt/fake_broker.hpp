// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "mqtt/broker_link.hpp"

namespace cornerd::mqtt {

/// A broker that keeps what is published.
class FakeBroker : public BrokerLink {
 public:
  void subscribe(const std::string& filter) override { filters.insert(filter); }
  void unsubscribe(const std::string& filter) override { filters.erase(filter); }
  std::uint64_t connections() const override { return connections_; }
  bool publish(const std::string& topic, std::string_view payload, bool is_retained,
               int /*qos*/) override {
    if (connections_ == 0) return false;
    messages.push_back({topic, std::string(payload), is_retained});
    return true;
  }
  bool has_sent_all() const override { return !is_busy; }

  void connect() { ++connections_; }
  std::size_t count(const std::string& topic) const {
    return static_cast<std::size_t>(
        std::count_if(messages.begin(), messages.end(),
                      [&](const Message& message) { return message.topic == topic; }));
  }
  /// Empty if there was none.
  std::string last(const std::string& topic) const {
    for (auto message = messages.rbegin(); message != messages.rend(); ++message) {
      if (message->topic == topic) return message->payload;
    }
    return {};
  }

  std::set<std::string> filters;
  std::vector<Message> messages;
  bool is_busy = false;

 private:
  std::uint64_t connections_ = 0;
};

}  // namespace cornerd::mqtt
