// SPDX-License-Identifier: MIT
// What a broker sends: through the whole bridge, from the topic's payload to the daemon's request.
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

#include "message/request.hpp"
#include "mqtt/bridge.hpp"
#include "mqtt/robot_report.hpp"
#include "tests/unit/mqtt/fake_broker.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace cornerd;
  const std::string payload(reinterpret_cast<const char*>(data), size);
  mqtt::parse_robot_report(payload);

  mqtt::BridgeConfig config;
  config.map = "hall";
  config.map_folder = "/proc/self/fd/none";
  mqtt::FakeBroker broker;
  broker.connect();
  const auto ask = [](const std::string& line, const auto& done) {
    // Whatever comes from the network, the daemon gets a request that it knows.
    const message::Request request = message::parse_request(line.substr(0, line.size() - 1));
    if (std::holds_alternative<message::RequestError>(request.body)) __builtin_trap();
    done(client::Answer{client::Answer::Kind::kOk, {}});
    return true;
  };
  mqtt::Bridge bridge(config, broker, ask);
  bridge.on_broker({mqtt::Vda5050(config).topic("instantActions"), payload, false});
  const std::string topic = mqtt::map_topic(config.site, config.map);
  bridge.on_broker({topic, payload, true});
  if (const auto announcement = mqtt::parse_map_announcement(payload)) {
    bridge.on_broker({mqtt::map_file_topic(config.site, *announcement), payload, true});
  }
  bridge.tick({1, {}});
  return 0;
}
