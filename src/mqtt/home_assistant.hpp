// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "mqtt/broker_link.hpp"
#include "mqtt/config.hpp"

namespace cornerd::mqtt {

/// Messages of Home Assistant's MQTT discovery, retained: state, room and position as sensors of
/// one device. They read the robot's report. `connection_topic`: that of VDA 5050.
std::vector<Message> home_assistant_discovery(const BridgeConfig& config,
                                              const std::string& connection_topic);

}  // namespace cornerd::mqtt
