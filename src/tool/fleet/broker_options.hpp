// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <functional>
#include <string>
#include <string_view>

#include "mqtt/broker.hpp"
#include "mqtt/config.hpp"

namespace cornerd::tool {

class Command;

/// --broker, --broker-config and --site of the commands for a fleet.
class BrokerOptions {
 public:
  void add(Command& command);
  bool is_given() const { return options_.is_given(); }

  /// Throws UsageError, or settings::SettingsError.
  mqtt::BrokerConfig broker() const;
  std::string site() const;

 private:
  mqtt::FleetOptions options_;
};

/// Throws Failure, with the reason, if there is no connection within seconds.
void wait_for_connection(mqtt::Broker& broker);
/// Publishes a retained message. Throws Failure if the broker does not acknowledge it within a
/// minute, or refuses it.
void publish_retained(mqtt::Broker& broker, const std::string& topic, std::string_view payload);
/// Calls `take` with each message until none has come for `silence`.
void take_until_silent(mqtt::Broker& broker, std::chrono::milliseconds silence,
                       const std::function<void(const mqtt::Message&)>& take);

}  // namespace cornerd::tool
