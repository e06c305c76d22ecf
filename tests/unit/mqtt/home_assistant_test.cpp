// SPDX-License-Identifier: MIT
#include "mqtt/home_assistant.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace cornerd::mqtt {
namespace {

TEST(HomeAssistant, Discovery_NamesTheReportAndTheConnection) {
  BridgeConfig config;
  config.manufacturer = "ac me";
  config.serial = "r:1";
  config.home_assistant = "homeassistant";
  const auto messages = home_assistant_discovery(config, "uagv/v2/ac me/r:1/connection");
  ASSERT_EQ(messages.size(), 4u);
  EXPECT_EQ(messages[1].topic, "homeassistant/sensor/cornerd_ac_me_r_1/room/config");
  const auto room = nlohmann::json::parse(messages[1].payload);
  EXPECT_EQ(room["state_topic"], "cornerd/default/robot/ac me/r:1");
  EXPECT_EQ(room["availability_topic"], "uagv/v2/ac me/r:1/connection");
  EXPECT_EQ(room["value_template"], "{{ value_json.room }}");
  EXPECT_EQ(nlohmann::json::parse(messages[2].payload)["unit_of_measurement"], "m");
}

}  // namespace
}  // namespace cornerd::mqtt
