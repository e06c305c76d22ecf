// SPDX-License-Identifier: MIT
#include "tool/fleet/broker_options.hpp"

#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <thread>

#include "tool/command_line/command.hpp"
#include "tool/command_line/failure.hpp"

namespace cornerd::tool {

namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds kPoll{10};
constexpr std::chrono::seconds kConnectTime{10};
constexpr std::chrono::seconds kStopTime{1};
constexpr std::chrono::seconds kAcknowledgementTime{60};

}  // namespace

void BrokerOptions::add(Command& command) {
  command.add_option("--broker", options_.broker, "the fleet's MQTT broker")
      .type_name("HOST[:PORT]");
  command
      .add_option("--broker-config", options_.config,
                  "broker (TLS, user, certificates) and site of a config of cornerd-mqtt")
      .type_name("FILE");
  command.add_option("--site", options_.site, "the site of the fleet; default: default")
      .type_name("SITE");
}

mqtt::BrokerConfig BrokerOptions::broker() const try {
  return options_.broker_config();
} catch (const std::invalid_argument& error) {
  throw UsageError(error.what());
}

std::string BrokerOptions::site() const try {
  return options_.site_name();
} catch (const std::invalid_argument& error) {
  throw UsageError(error.what());
}

void wait_for_connection(mqtt::Broker& broker) {
  const Clock::time_point until = Clock::now() + kConnectTime;
  while (!broker.is_connected() && Clock::now() < until) std::this_thread::sleep_for(kPoll);
  if (broker.is_connected()) return;
  const std::string reason = "no broker: " + broker.problem();
  if (broker.stop(kStopTime)) throw Failure(reason);
  // A machine that does not answer keeps the thread for two minutes.
  std::fprintf(stderr, "cornerctl: %s\n", reason.c_str());
  std::_Exit(kExitFailed);
}

void publish_retained(mqtt::Broker& broker, const std::string& topic, std::string_view payload) {
  const std::string failure = topic + ": the broker has not taken it: ";
  if (!broker.publish(topic, payload, /*is_retained=*/true, /*qos=*/1)) {
    throw Failure(failure + (broker.is_connected() ? "larger than it allows" : broker.problem()));
  }
  const Clock::time_point until = Clock::now() + kAcknowledgementTime;
  while (broker.unacknowledged() > 0) {
    if (Clock::now() > until || !broker.is_connected()) throw Failure(failure + broker.problem());
    std::this_thread::sleep_for(kPoll);
  }
  if (!broker.refusal().empty()) throw Failure(failure + broker.refusal());
}

void take_until_silent(mqtt::Broker& broker, std::chrono::milliseconds silence,
                       const std::function<void(const mqtt::Message&)>& take) {
  Clock::time_point last = Clock::now();
  while (Clock::now() - last < silence) {
    for (const mqtt::Message& message : broker.take()) {
      take(message);
      last = Clock::now();
    }
    std::this_thread::sleep_for(kPoll);
  }
}

}  // namespace cornerd::tool
