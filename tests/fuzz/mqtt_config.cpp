// SPDX-License-Identifier: MIT
// The config of cornerd-mqtt.
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "mqtt/config.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace cornerd;
  try {
    const mqtt::BridgeConfig config = mqtt::parse_bridge_config(
        {reinterpret_cast<const char*>(data), size}, "/etc/cornerd/mqtt.json");
    // What is a level of a topic stays one.
    if (!mqtt::is_topic_level(config.manufacturer) || !mqtt::is_topic_level(config.serial) ||
        !mqtt::is_topic_level(config.site)) {
      __builtin_trap();
    }
  } catch (const settings::SettingsError&) {
    // What a wrong config gives.
  }
  return 0;
}
