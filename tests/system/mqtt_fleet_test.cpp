// SPDX-License-Identifier: MIT
// Three daemons with their bridges: one map for all. tests/mqtt/fleet does it with twenty.
#include <gtest/gtest.h>

#include <array>
#include <fstream>
#include <list>
#include <string>

#include "daemon_process.hpp"
#include "mosquitto_process.hpp"
#include "mqtt/broker.hpp"
#include "mqtt/fleet.hpp"
#include "mqtt/map_announcement.hpp"
#include "settings/sha256.hpp"
#include "tests/wait_until.hpp"

namespace cornerd::system_test {
namespace {

using test::wait_until;

class MqttFleet : public DaemonTest {
 protected:
  static constexpr std::size_t kRobots = 3;

  MqttFleet() : port_(free_port()), broker_(folder_ / "broker", port_) {
    std::filesystem::create_directory(folder_ / "fleet");
    mqtt::BrokerConfig config;
    config.host = "127.0.0.1";
    config.port = port_;
    listener_ = std::make_unique<mqtt::Broker>(config);
    listener_->subscribe(fleet_.filter());
    EXPECT_TRUE(wait_until([&] { return listener_->is_connected(); }));
    for (std::size_t i = 0; i < kRobots; ++i) add_robot(std::to_string(i));
  }

  void add_robot(const std::string& name) {
    const std::string pose = (folder_ / ("pose" + name)).string();
    const std::string control = (folder_ / ("control" + name)).string();
    daemons_.emplace_back(
        std::vector<std::string>{"--config", config(), "--set", "/socket/pose=" + pose, "--set",
                                 "/socket/control=" + control, "--set", "/lidar/speed=1", "--set",
                                 "/lidar/loop=true"},
        folder_ / ("daemon" + name));
    const std::filesystem::path file = folder_ / ("mqtt" + name + ".json");
    // A folder of its own: each robot is a machine.
    std::filesystem::create_directory(folder_ / ("fleet" + name));
    std::ofstream(file) << R"({"broker":{"host":"127.0.0.1","port":)" << port_
                        << R"(},"robot":{"manufacturer":"acme","serial":")" << name
                        << R"("},"site":{"map":"hall","map_folder":"fleet)" << name
                        << R"("},"socket":{"pose":")" << pose << R"(","control":")" << control
                        << "\"}}";
    bridges_.emplace_back(std::vector<std::string>{"--config", file.string()},
                          folder_ / ("bridge" + name), std::map<std::string, std::string>{},
                          std::vector<int>{}, CORNERD_MQTT_BINARY);
  }
  DaemonProcess cornerctl(std::vector<std::string> arguments) {
    arguments.insert(arguments.end(), {"--broker", "127.0.0.1:" + std::to_string(port_)});
    return {arguments, folder_ / "cornerctl.log", {}, {}, CORNERCTL_BINARY};
  }
  /// True when each robot's report is so.
  bool all_report(const auto& is_it) {
    return wait_until([&] {
      for (const mqtt::Message& message : listener_->take()) {
        fleet_.take(message, 0, std::chrono::system_clock::now());
      }
      const auto robots = fleet_.robots(0);
      return robots.size() == kRobots &&
             std::all_of(robots.begin(), robots.end(),
                         [&](const auto& robot) { return is_it(robot.report); });
    });
  }
  std::string outputs() const {
    std::string text;
    for (const DaemonProcess& one : daemons_) text += one.output();
    for (const DaemonProcess& one : bridges_) text += one.output();
    return text;
  }

  std::uint16_t port_;
  MosquittoProcess broker_;
  mqtt::Fleet fleet_{"default"};
  std::unique_ptr<mqtt::Broker> listener_;
  std::list<DaemonProcess> daemons_;
  std::list<DaemonProcess> bridges_;
};

TEST_F(MqttFleet, PublishedMap_IsOnAllAndACorruptOneOnNone) {
  ASSERT_TRUE(all_report([](const auto& report) { return report.is_localized; })) << outputs();
  std::list<TestClient> clients;
  for (std::size_t i = 0; i < kRobots; ++i) {
    clients.push_back(connect(("pose" + std::to_string(i)).c_str()));
  }
  // Another map of the same room.
  const std::filesystem::path map = folder_ / "next.json";
  std::filesystem::copy_file(folder_ / "map.json", map);
  std::ofstream(map, std::ios::app) << "\n// the next version\n";
  DaemonProcess publish = cornerctl({"map", "publish", map.string(), "--name", "hall"});
  EXPECT_EQ(publish.wait_for_exit(), 0) << publish.output();
  ASSERT_TRUE(all_report([](const auto& report) {
    return report.map_version == 1 && report.problem.empty() && report.is_localized;
  })) << outputs();

  // What a broken disk, or somebody else, announces.
  const std::string text = "{\"format\":\"cornerd-map\"}";
  mqtt::MapAnnouncement corrupt{"hall", 2, settings::sha256("other"), text.size()};
  listener_->publish(mqtt::map_file_topic("default", corrupt), text, true, 1);
  listener_->publish(mqtt::map_topic("default", "hall"), mqtt::map_announcement_json(corrupt), true,
                     1);
  ASSERT_TRUE(all_report([](const auto& report) {
    return report.map_version == 1 && report.problem.find("version 2") != std::string::npos;
  })) << outputs();
  for (TestClient& client : clients) EXPECT_EQ(next_of(client, "POSE")["class"], "POSE");

  DaemonProcess table = cornerctl({"fleet", "--once"});
  EXPECT_EQ(table.wait_for_exit(), 0);
  EXPECT_NE(table.output().find("acme/2"), std::string::npos) << table.output();
}

}  // namespace
}  // namespace cornerd::system_test
