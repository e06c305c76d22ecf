// SPDX-License-Identifier: MIT
// cornerd-mqtt as a process between a daemon and Debian's mosquitto.
#include <gtest/gtest.h>

#include <csignal>
#include <deque>
#include <fstream>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "daemon_process.hpp"
#include "drivers/serial/file_descriptor.hpp"
#include "mosquitto_process.hpp"
#include "mqtt/broker.hpp"
#include "tests/wait_until.hpp"

namespace cornerd::system_test {
namespace {

using test::wait_until;

class Mqtt : public DaemonTest {
 protected:
  Mqtt() : port_(free_port()) {}

  /// `more`: further keys of the config.
  DaemonProcess start_bridge(const std::string& name = "mqtt", const std::string& more = {}) {
    std::ofstream(folder_ / (name + ".json"))
        << R"({ "broker": { "host": "127.0.0.1", "port": )" << port_
        << R"( }, "robot": { "manufacturer": "acme", "serial": "r-1" }, "visualization_hz": 10)"
        << more << R"(, "socket": { "pose": "pose.sock", "control": "control.sock" } })";
    return {{"--config", (folder_ / (name + ".json")).string()},
            folder_ / (name + ".log"),
            {},
            {},
            CORNERD_MQTT_BINARY};
  }
  void start_broker() { broker_ = std::make_unique<MosquittoProcess>(folder_ / "broker", port_); }
  void listen(const std::string& filter) {
    mqtt::BrokerConfig config;
    config.host = "127.0.0.1";
    config.port = port_;
    listener_ = std::make_unique<mqtt::Broker>(config);
    listener_->subscribe(filter);
    ASSERT_TRUE(wait_until([&] { return listener_->is_connected(); })) << listener_->problem();
  }
  /// Waits for a message of the robot whose topic ends so, and of which `is_it` is true.
  bool hears(const std::string& name, const std::function<bool(const json&)>& is_it) {
    return wait_until([&] {
      for (mqtt::Message& message : listener_->take()) heard_.push_back(std::move(message));
      while (!heard_.empty()) {
        const mqtt::Message message = std::move(heard_.front());
        heard_.pop_front();
        if (!message.topic.ends_with("/" + name)) continue;
        last_ = message.payload;
        if (is_it(json::parse(message.payload))) return true;
      }
      return false;
    });
  }
  bool hears_connection(const std::string& state) {
    return hears("connection", [&](const json& told) { return told["connectionState"] == state; });
  }
  static bool is_localized(const json& told) { return told["agvPosition"]["positionInitialized"]; }
  void act(const std::string& payload, bool is_retained = false) {
    EXPECT_TRUE(listener_->publish("uagv/v2/acme/r-1/instantActions", payload, is_retained));
  }

  std::uint16_t port_;
  std::unique_ptr<MosquittoProcess> broker_;
  std::unique_ptr<mqtt::Broker> listener_;
  std::deque<mqtt::Message> heard_;
  std::string last_;
};

TEST_F(Mqtt, Robot_IsSeenAndItsDeathToo) {
  start_broker();
  listen("uagv/v2/acme/r-1/#");
  const DaemonProcess daemon = start();
  const DaemonProcess bridge = start_bridge();
  EXPECT_TRUE(hears_connection("ONLINE")) << bridge.output();
  EXPECT_TRUE(hears("visualization", is_localized)) << last_;
  EXPECT_TRUE(hears("state", is_localized)) << last_;
  bridge.send_signal(SIGKILL);
  EXPECT_TRUE(hears_connection("CONNECTIONBROKEN"));
}

TEST_F(Mqtt, BrokerThatRestarts_GetsEverythingAgain) {
  start_broker();
  const DaemonProcess daemon = start();
  DaemonProcess bridge = start_bridge();
  listen("uagv/v2/acme/r-1/#");
  EXPECT_TRUE(hears_connection("ONLINE"));
  broker_.reset();
  start_broker();
  EXPECT_TRUE(hears_connection("ONLINE"));
  EXPECT_TRUE(hears("factsheet", [](const json&) { return true; }));
  // The bridge may have been faster than this listener.
  act(R"({"actions":[{"actionType":"stateRequest","actionId":"s"}]})");
  EXPECT_TRUE(hears("state", is_localized)) << last_;
  bridge.send_signal(SIGTERM);
  EXPECT_TRUE(hears_connection("OFFLINE"));
  EXPECT_EQ(bridge.wait_for_exit(), 0);
}

TEST_F(Mqtt, InitPosition_ReachesTheDaemonThroughAFlood) {
  start_broker();
  listen("uagv/v2/acme/r-1/state");
  const DaemonProcess daemon = start();
  const DaemonProcess bridge = start_bridge();
  EXPECT_TRUE(hears("state", is_localized));
  TestClient witness = connect();
  int requests = 0;
  for (int i = 0; i < 2000; ++i) act(R"({"actions":[{"actionId":)" + std::string(i % 3, '"'));
  act(std::string(1 << 20, '['));
  act(R"({"actions":[{"actionType":"initPosition","actionId":"old","actionParameters":[)"
      R"({"key":"x","value":0.4},{"key":"y","value":1},{"key":"theta","value":0}]}]})",
      /*is_retained=*/true);
  const auto is_finished = [](const json& told) {
    for (const json& action : told["actionStates"]) {
      if (action["actionId"] == "new" && action["actionStatus"] == "FINISHED") return true;
    }
    return false;
  };
  // As a master does that gets no answer: of a flood the bridge keeps 1,024 messages. An action
  // runs once.
  EXPECT_TRUE(hears("state", [&](const json& told) {
    act(R"({"actions":[{"actionType":"initPosition","actionId":"new","actionParameters":[)"
        R"({"key":"x","value":0.4},{"key":"y","value":1},{"key":"theta","value":0}]},)"
        R"({"actionType":"stateRequest","actionId":")" +
        std::to_string(++requests) + "\"}]}");
    return is_finished(told);
  })) << last_;
  EXPECT_TRUE(daemon.is_running());
  EXPECT_EQ(next_of(witness, "POSE")["class"], "POSE");
}

TEST_F(Mqtt, SecondRobotOfOneSerial_IsNamed) {
  start_broker();
  const DaemonProcess one = start_bridge();
  const DaemonProcess two = start_bridge("two");
  EXPECT_TRUE(wait_until([&] {
    return (one.output() + two.output()).find("does another client have this") != std::string::npos;
  })) << one.output()
      << two.output();
}

TEST_F(Mqtt, BrokerThatSaysNothing_DelaysNoEnd) {
  const SilentListener silent(port_);
  DaemonProcess bridge = start_bridge();
  EXPECT_TRUE(wait_until([&] { return silent.has_client(); }));
  bridge.send_signal(SIGTERM);
  EXPECT_EQ(bridge.wait_for_exit(), 0);
}

TEST_F(Mqtt, WhatTheBrokerRefuses_IsAFailureThatIsNamed) {
  const std::filesystem::path acl = folder_ / "acl";
  std::ofstream(acl) << "topic read #\ntopic write cornerd/mine/#\n";
  const MosquittoProcess strict(folder_ / "strict", port_,
                                "acl_file " + acl.string() + "\nmax_packet_size 4096\n");
  const std::filesystem::path large = folder_ / "large.json";
  std::filesystem::copy_file(folder_ / "map.json", large);
  std::ofstream(large, std::ios::app) << "// " << std::string(8192, '-') << "\n";
  const auto publish = [&](const char* map, const char* site) {
    DaemonProcess run({"map", "publish", (folder_ / map).string(), "--site", site, "--broker",
                       "127.0.0.1:" + std::to_string(port_)},
                      folder_ / "publish.log", {}, {}, CORNERCTL_BINARY);
    const std::optional<int> code = run.wait_for_exit();
    return std::to_string(code.value_or(-1)) + " " + run.output();
  };
  EXPECT_TRUE(publish("map.json", "mine").starts_with("0 "));
  EXPECT_NE(publish("map.json", "other").find("Not authorized"), std::string::npos);
  EXPECT_NE(publish("large.json", "mine").find("larger"), std::string::npos);
}

TEST_F(Mqtt, WrongConfig_IsNamed) {
  DaemonProcess bridge = start_bridge("wrong", R"(, "vda5050": "9")");
  EXPECT_EQ(bridge.wait_for_exit(), 78);
  EXPECT_NE(bridge.output().find("/vda5050"), std::string::npos) << bridge.output();
}

/// A broker that consents to MQTT 5 and goes on with a property that there is not.
void serve_nonsense(const LoopbackSocket& listener) {
  const drivers::FileDescriptor client(::accept(listener.fd(), nullptr, nullptr));
  char bytes[256];
  EXPECT_GT(::recv(client.get(), bytes, sizeof bytes, 0), 0);
  const std::string all("\x20\x03\0\0\0\x30\x06\0\x01t\x02\x7f\0", 13);
  ::send(client.get(), all.data(), all.size(), MSG_NOSIGNAL);
  ::recv(client.get(), bytes, sizeof bytes, 0);
}

// libmosquitto 2.0.11 of Debian 12 aborts; later ones end the connection.
TEST_F(Mqtt, BrokerThatSendsNonsense_IsNamedWithTheWayOut) {
  const LoopbackSocket listener(port_);
  ASSERT_EQ(::listen(listener.fd(), 4), 0);
  const DaemonProcess bridge = start_bridge();
  serve_nonsense(listener);
  const std::string words = "broker 127.0.0.1:" + std::to_string(port_) +
                            ": what it sends is no MQTT 5, and libmosquitto ends this process";
  EXPECT_TRUE(wait_until([&] { return bridge.output().find(words) != std::string::npos; }))
      << bridge.output();
}

}  // namespace
}  // namespace cornerd::system_test
