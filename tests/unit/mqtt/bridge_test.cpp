// SPDX-License-Identifier: MIT
#include "mqtt/bridge.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <set>
#include <vector>

#include <nlohmann/json.hpp>

#include "fake_broker.hpp"

namespace cornerd::mqtt {
namespace {

using nlohmann::json;
using ::testing::Contains;

class BridgeTest : public ::testing::Test {
 protected:
  BridgeTest()
      : bridge_(config_, broker_, [this](std::string line, auto done) {
          if (asked_.size() == 2) return false;
          asked_.push_back({std::move(line), std::move(done)});
          return true;
        }) {}

  Bridge::Now now() {
    return {t_s_, Vda5050::UnixTime(std::chrono::milliseconds(static_cast<long>(1000 * t_s_)))};
  }
  void tick(double after_s) {
    t_s_ += after_s;
    bridge_.tick(now());
  }
  void daemon(const std::string& line) { bridge_.on_daemon(client::Event::kMessage, line, now()); }
  void pose(const std::string& state = "fix") {
    daemon(R"({"class":"POSE","seq":1,"t":1,"state":")" + state +
           (state == "lost" ? "\"}"
                            : R"(","x":1,"y":2,"theta":0,"cov":{"xx":1e-6,"xy":0,"xt":0,)"
                              R"("yy":1e-6,"yt":0,"tt":1e-6},"room":"hall","age":0})"));
  }
  void act(const std::string& type, const std::string& id, const std::string& parameters = "[]",
           bool is_retained = false) {
    bridge_.on_broker({topic("instantActions"),
                       R"({"actions":[{"actionType":")" + type + R"(","actionId":")" + id +
                           R"(","actionParameters":)" + parameters + "}]}",
                       is_retained});
  }
  static std::string position(const std::string& map) {
    return R"([{"key":"x","value":1},{"key":"y","value":2},{"key":"theta","value":0},)"
           R"({"key":"mapId","value":")" +
           map + R"("},{"key":"lastNodeId","value":"n7"}])";
  }
  static std::string topic(const std::string& name) { return "uagv/v2/cornerd/r-1/" + name; }
  json last(const std::string& name) { return json::parse(broker_.last(topic(name))); }
  std::size_t count(const std::string& name) { return broker_.count(topic(name)); }
  json action(std::size_t i) {
    tick(0.2);
    return last("state")["actionStates"][i];
  }

  struct Asked {
    std::string line;
    std::function<void(const client::Answer&)> done;
  };
  double t_s_ = 100;
  BridgeConfig config_ = [] {
    BridgeConfig config;
    config.serial = "r-1";
    return config;
  }();
  FakeBroker broker_;
  std::vector<Asked> asked_;
  Bridge bridge_;
};

TEST_F(BridgeTest, Connection_IsGreetedWithAllThatIsRetained) {
  tick(0.1);
  EXPECT_TRUE(broker_.messages.empty()) << "no broker";
  broker_.connect();
  tick(0.1);
  EXPECT_EQ(last("connection")["connectionState"], "ONLINE");
  EXPECT_EQ(count("factsheet"), 1u);
  EXPECT_EQ(count("state"), 1u);
  EXPECT_EQ(broker_.count("cornerd/default/robot/cornerd/r-1"), 1u);
  EXPECT_THAT(broker_.filters, Contains(topic("instantActions")));
  broker_.connect();  // the broker restarted
  tick(0.1);
  EXPECT_EQ(count("connection"), 2u);
  EXPECT_EQ(count("factsheet"), 2u);
  EXPECT_EQ(count("state"), 2u);
  bridge_.say_goodbye(now());
  EXPECT_EQ(last("connection")["connectionState"], "OFFLINE");
}

TEST_F(BridgeTest, State_ComesOnEventsAndEvery30Seconds) {
  broker_.connect();
  bridge_.on_daemon(client::Event::kConnected, "", now());
  tick(0.1);
  pose();
  tick(0.2);
  EXPECT_EQ(count("state"), 2u);
  EXPECT_EQ(last("state")["agvPosition"]["positionInitialized"], true);
  for (int i = 0; i < 290; ++i) {
    pose();
    tick(0.1);
  }
  EXPECT_EQ(count("state"), 2u);
  for (int i = 0; i < 15; ++i) {
    pose();
    tick(0.1);
  }
  EXPECT_EQ(count("state"), 3u);
  pose("lost");
  tick(0.2);
  EXPECT_EQ(last("state")["errors"][0]["errorType"], "LOCALIZATION_ERROR");
  bridge_.on_daemon(client::Event::kLost, "it is gone", now());
  tick(0.2);
  EXPECT_NE(last("state")["errors"][0]["errorDescription"].get<std::string>().find("it is gone"),
            std::string::npos);
}

TEST_F(BridgeTest, Visualization_KeepsItsRateAndAnOverloadedBroker) {
  broker_.connect();
  bridge_.on_daemon(client::Event::kConnected, "", now());
  for (int i = 0; i < 400; ++i) {
    t_s_ += 0.025;
    pose();
  }
  EXPECT_NEAR(static_cast<double>(count("visualization")), 50, 2);
  const std::size_t before = count("visualization");
  broker_.is_busy = true;
  for (int i = 0; i < 400; ++i) {
    t_s_ += 0.025;
    pose();
  }
  EXPECT_EQ(count("visualization"), before);
}

TEST_F(BridgeTest, PoseOfTheMapBefore_IsNoneInTheNextOne) {
  broker_.connect();
  bridge_.on_daemon(client::Event::kConnected, "", now());
  const auto map = [&](const std::string& name, char digit) {
    daemon(R"({"class":"MAP","name":")" + name + R"(","hash":")" + std::string(64, digit) +
           R"(","thickness":0.02,"walls":[{"from":[0,0],"to":[1,0]}],"rooms":[]})");
  };
  map("ground", 'a');
  pose();
  map("ground", 'a');
  tick(0.2);
  EXPECT_EQ(last("state")["agvPosition"]["positionInitialized"], true);
  map("upper", 'b');
  tick(0.2);
  EXPECT_EQ(last("state")["agvPosition"]["mapId"], "upper");
  EXPECT_EQ(last("state")["agvPosition"]["positionInitialized"], false);
  pose();
  tick(0.2);
  EXPECT_EQ(last("state")["agvPosition"]["positionInitialized"], true);
}

TEST_F(BridgeTest, InitPosition_IsSetPose) {
  broker_.connect();
  act("initPosition", "a", position(""));
  ASSERT_EQ(asked_.size(), 1u);
  EXPECT_EQ(asked_[0].line, "{\"class\":\"SET_POSE\",\"x\":1,\"y\":2,\"theta\":0}\n");
  EXPECT_EQ(action(0)["actionStatus"], "RUNNING");
  asked_[0].done({client::Answer::Kind::kOk, R"({"class":"OK"})"});
  EXPECT_EQ(action(0)["actionStatus"], "FINISHED");
  EXPECT_EQ(last("state")["lastNodeId"], "n7");
}

TEST_F(BridgeTest, InitPositionInAnotherMap_SetsTheMapFirst) {
  broker_.connect();
  act("initPosition", "a", position("floor 2"));
  ASSERT_EQ(asked_.size(), 1u);
  EXPECT_EQ(asked_[0].line, "{\"class\":\"SET_MAP\",\"name\":\"floor 2\"}\n");
  asked_[0].done({client::Answer::Kind::kOk, ""});
  ASSERT_EQ(asked_.size(), 2u);
  EXPECT_NE(asked_[1].line.find("SET_POSE"), std::string::npos);
  asked_[1].done(
      {client::Answer::Kind::kError, R"({"class":"ERROR","code":"outside","message":"far away"})"});
  EXPECT_EQ(action(0)["actionStatus"], "FAILED");
  EXPECT_EQ(action(0)["resultDescription"], "far away");
}

TEST_F(BridgeTest, UnknownRepeatedRetainedAndBrokenActions_AskForNothing) {
  broker_.connect();
  act("pick", "p");
  EXPECT_EQ(action(0)["actionStatus"], "FAILED");
  EXPECT_EQ(last("state")["errors"].back()["errorType"], "INVALID_INSTANT_ACTION");
  act("initPosition", "r", position(""), /*is_retained=*/true);
  act("initPosition", "w", R"([{"key":"x","value":"far"}])");
  for (const char* garbage : {"", "{", "\xff", "{\"actions\":7}"}) {
    bridge_.on_broker({topic("instantActions"), garbage});
  }
  EXPECT_TRUE(asked_.empty());
  act("initPosition", "a", position(""));
  act("initPosition", "a", position(""));
  EXPECT_EQ(asked_.size(), 1u);
  tick(0.2);
  EXPECT_NO_THROW(last("state"));
}

TEST_F(BridgeTest, Flood_IsBoundedAndRefused) {
  broker_.connect();
  for (int i = 0; i < 1000; ++i) act("initPosition", std::to_string(i), position(""));
  EXPECT_EQ(asked_.size(), 2u);
  tick(0.2);
  EXPECT_EQ(last("state")["actionStates"].size(), kMaxActionStates);
  EXPECT_LE(count("state"), 2u);
}

TEST_F(BridgeTest, Requests_GetStateAndFactsheet) {
  broker_.connect();
  tick(0.1);
  act("factsheetRequest", "f");
  act("stateRequest", "s");
  tick(0.2);
  EXPECT_EQ(count("factsheet"), 2u);
  EXPECT_EQ(last("state")["actionStates"][1]["actionStatus"], "FINISHED");
}

TEST_F(BridgeTest, ClearedActions_AreGoneButThoseThatRun) {
  broker_.connect();
  act("pick", "p");
  act("initPosition", "a", position(""));
  act("clearInstantActions", "c");
  tick(0.2);
  const json actions = last("state")["actionStates"];
  ASSERT_EQ(actions.size(), 2u) << actions;
  EXPECT_EQ(actions[0]["actionId"], "a");
  EXPECT_EQ(actions[1]["actionStatus"], "FINISHED") << "the clearing itself";
}

TEST_F(BridgeTest, SteppedClock_DisturbsNoInterval) {
  broker_.connect();
  tick(0.1);
  const std::size_t before = count("state");
  for (const long hours : {-10'000, 10'000}) {
    t_s_ += 0.2;
    bridge_.tick({t_s_, Vda5050::UnixTime(std::chrono::hours(hours))});
  }
  EXPECT_EQ(count("state"), before);
}

}  // namespace
}  // namespace cornerd::mqtt
