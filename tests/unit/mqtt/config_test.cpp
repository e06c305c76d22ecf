// SPDX-License-Identifier: MIT
#include "mqtt/config.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "settings/config.hpp"
#include "tests/temporary_folder.hpp"

namespace cornerd::mqtt {
namespace {

using settings::SettingsError;

BridgeConfig parse(const std::string& text) {
  return parse_bridge_config(text, "/etc/x/mqtt.json");
}

TEST(MqttConfig, EmptyObject_HasDefaults) {
  const BridgeConfig config = parse("{} // nothing");
  EXPECT_EQ(config.broker.host, "localhost");
  EXPECT_EQ(config.broker.port, 1883);
  EXPECT_FALSE(config.broker.is_tls);
  EXPECT_TRUE(config.broker.is_v5);
  EXPECT_FALSE(config.serial.empty());
  EXPECT_EQ(config.vda5050, VdaVersion::kV21);
  EXPECT_TRUE(config.home_assistant.empty());
  EXPECT_EQ(config.broker.client_id, "cornerd-cornerd-" + config.serial);
}

TEST(MqttConfig, EveryKey_IsRead) {
  const BridgeConfig config = parse(R"({
    "broker": {"host": "mq", "tls": {"ca": "ca.pem", "certificate": "c.pem", "key": "/k.pem"},
               "user": "u", "protocol": "3.1.1"},
    "robot": {"manufacturer": "acme", "serial": "r-1"}, "vda5050": "3.0",
    "visualization_hz": 10, "max_deviation": 0.1, "max_age": 1,
    "vehicle": {"series": "s", "class": "TUGGER", "kinematics": "OMNI", "max_speed": 1,
                "max_acceleration": 2, "width": 0.1, "length": 0.2, "height": 0.4, "max_load": 3},
    "site": {"name": "hq", "map": "hall", "map_folder": "fleet"}, "home_assistant": "ha",
    "socket": {"pose": "p", "control": "c"} })");
  EXPECT_EQ(config.broker.port, 8883);
  EXPECT_EQ(config.broker.ca, "/etc/x/ca.pem");
  EXPECT_EQ(config.broker.key, "/k.pem");
  EXPECT_FALSE(config.broker.is_v5);
  EXPECT_EQ(config.vda5050, VdaVersion::kV30);
  EXPECT_EQ(config.vehicle.kinematics, Kinematics::kOmnidirectional);
  EXPECT_EQ(config.vehicle.vehicle_class, "TUGGER");
  EXPECT_EQ(config.map_folder, "/etc/x/fleet");
  EXPECT_EQ(config.socket.pose, "/etc/x/p");
}

TEST(MqttConfig, WrongValue_IsNamedByItsPointer) {
  const std::pair<const char*, const char*> cases[] = {
      {R"({"brocker": {}})", "/brocker"},
      {R"({"broker": {"port": 0}})", "/broker/port"},
      {R"({"broker": {"port": "1883"}})", "/broker/port"},
      {R"({"broker": {"tls": true}})", "/broker/tls"},
      {R"({"broker": {"tls": {"key": "k"}}})", "/broker/tls/certificate"},
      {R"({"broker": {"password_file": "p"}})", "/broker/user"},
      {R"({"broker": {"protocol": "4"}})", "/broker/protocol"},
      {R"({"robot": {"manufacturer": "a/b"}})", "/robot/manufacturer"},
      {R"({"robot": {"serial": "a b"}})", "/robot/serial"},
      {R"({"vda5050": "1.1"})", "/vda5050"},
      {R"({"visualization_hz": 11})", "/visualization_hz"},
      {R"({"site": {"name": "#"}})", "/site/name"},
      {R"({"home_assistant": "a/+"})", "/home_assistant"},
      {R"({"vehicle": {"class": "DRONE"}})", "/vehicle/class"}};
  for (const auto& [text, pointer] : cases) {
    try {
      parse(text);
      ADD_FAILURE() << text;
    } catch (const SettingsError& error) {
      EXPECT_NE(std::string(error.what()).find(pointer), std::string::npos) << error.what();
    }
  }
}

TEST(MqttConfig, AbsentTlsFile_IsNamed) {
  const test::TemporaryFolder folder;
  const std::filesystem::path file = folder / "mqtt.json";
  std::ofstream(file) << R"({"broker": {"tls": {"ca": "absent.pem"}}})";
  try {
    load_bridge_config(file);
    FAIL() << "it is not there";
  } catch (const SettingsError& error) {
    EXPECT_NE(std::string(error.what()).find("/broker/tls/ca"), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("absent.pem"), std::string::npos);
  }
}

TEST(MqttConfig, BrokerAt_IsHostAndPort) {
  EXPECT_EQ(broker_at("mq").port, 1883);
  EXPECT_EQ(broker_at("mq:99").port, 99);
  EXPECT_EQ(broker_at("[::1]:99").host, "::1");
  EXPECT_EQ(broker_at("::1").host, "::1");
  for (const char* wrong : {"", ":1", "mq:", "mq:0", "mq:65536", "mq:x"}) {
    EXPECT_THROW(broker_at(wrong), std::invalid_argument) << wrong;
  }
}

TEST(MqttConfig, TopicLevel_HasNoWildcardAndNoSeparator) {
  EXPECT_TRUE(is_topic_level("hall 1"));
  for (const char* wrong : {"", "a/b", "+", "#", "a\nb"}) EXPECT_FALSE(is_topic_level(wrong));
}

TEST(FleetOptions, BrokerAndSite_AreCheckedForEveryProgram) {
  const FleetOptions given{"mq:1884", "", "hq"};
  EXPECT_EQ(given.broker_config().port, 1884);
  EXPECT_EQ(given.site_name(), "hq");
  EXPECT_EQ(FleetOptions{}.site_name(), "default");
  EXPECT_THROW(FleetOptions{}.broker_config(), std::invalid_argument);
  EXPECT_THROW((FleetOptions{"mq", "bridge.json", ""}.broker_config()), std::invalid_argument);
  EXPECT_THROW((FleetOptions{"mq:x", "", ""}.broker_config()), std::invalid_argument);
  EXPECT_THROW((FleetOptions{"mq", "", "a/b"}.site_name()), std::invalid_argument);
}

}  // namespace
}  // namespace cornerd::mqtt
