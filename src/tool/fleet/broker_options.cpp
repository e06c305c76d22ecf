// SPDX-License-Identifier: MIT
#include "tool/fleet/broker_options.hpp"

#include <cstdio>
#include <cstdlib>
#include <thread>

#include "mqtt/config.hpp"
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
  command.add_option("--broker", broker_, "the fleet's MQTT broker").type_name("HOST[:PORT]");
  command
      .add_option("--broker-config", config_,
                  "broker (TLS, user, certificates) and site of a config of cornerd-mqtt")
      .type_name("FILE");
  command.add_option("--site", site_, "the site of the fleet; default: default")
      .type_name("SITE")
      .check([](const std::string& site) {
        return mqtt::is_topic_level(site) ? "" : "must not have '/', '+' or '#'";
      });
}

mqtt::BrokerConfig BrokerOptions::broker() const {
  if (broker_.empty() == config_.empty()) {
    throw UsageError("one of --broker HOST[:PORT] and --broker-config FILE is needed");
  }
  if (broker_.empty()) {
    mqtt::BrokerConfig broker = mqtt::load_bridge_config(config_).broker;
    broker.client_id.clear();  // the robot's own
    return broker;
  }
  try {
    return mqtt::broker_at(broker_);
  } catch (const std::invalid_argument& error) {
    throw UsageError(std::string("--broker: ") + error.what());
  }
}

std::string BrokerOptions::site() const {
  if (!site_.empty()) return site_;
  return config_.empty() ? mqtt::BridgeConfig().site : mqtt::load_bridge_config(config_).site;
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
