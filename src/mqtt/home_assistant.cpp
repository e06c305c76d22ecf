// SPDX-License-Identifier: MIT
#include "mqtt/home_assistant.hpp"

#include <algorithm>
#include <cctype>

#include <nlohmann/json.hpp>

#include "mqtt/robot_report.hpp"

namespace cornerd::mqtt {

namespace {

using nlohmann::json;

struct Sensor {
  const char* key;
  const char* name;
  const char* icon;
  const char* value;
  bool is_length = false;
};

// "None" is Home Assistant's word for a number that is not known.
constexpr Sensor kSensors[] = {
    {"state", "State", "mdi:robot", "{{ value_json.state }}"},
    {"room", "Room", "mdi:floor-plan", "{{ value_json.room }}"},
    {"x", "Position x", "mdi:axis-x-arrow", "{{ value_json.x | default('None') }}", true},
    {"y", "Position y", "mdi:axis-y-arrow", "{{ value_json.y | default('None') }}", true}};

/// Letters, digits, '_' and '-' alone make an object id.
std::string object_id(const BridgeConfig& config) {
  std::string id = "cornerd_" + config.manufacturer + "_" + config.serial;
  std::replace_if(
      id.begin(), id.end(),
      [](unsigned char c) { return std::isalnum(c) == 0 && c != '_' && c != '-'; }, '_');
  return id;
}

}  // namespace

std::vector<Message> home_assistant_discovery(const BridgeConfig& config,
                                              const std::string& connection_topic) {
  const std::string id = object_id(config);
  std::vector<Message> messages;
  for (const Sensor& sensor : kSensors) {
    json content = {{"name", sensor.name},
                    {"unique_id", id + "_" + sensor.key},
                    {"icon", sensor.icon},
                    {"state_topic", robot_topic(config)},
                    {"value_template", sensor.value},
                    {"availability_topic", connection_topic},
                    {"availability_template",
                     "{{ 'online' if value_json.connectionState == 'ONLINE' else 'offline' }}"},
                    {"device",
                     {{"identifiers", json::array({id})},
                      {"name", config.serial},
                      {"manufacturer", config.manufacturer},
                      {"model", config.vehicle.series}}}};
    if (sensor.is_length) {
      content["unit_of_measurement"] = "m";
      content["state_class"] = "measurement";
    }
    messages.push_back({config.home_assistant + "/sensor/" + id + "/" + sensor.key + "/config",
                        content.dump(-1, ' ', false, json::error_handler_t::replace), true});
  }
  return messages;
}

}  // namespace cornerd::mqtt
