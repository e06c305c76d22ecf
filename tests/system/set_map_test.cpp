// SPDX-License-Identifier: MIT
// Another map while clients are served: SET_MAP and SIGHUP.
#include <gtest/gtest.h>
#include <signal.h>

#include <cstdint>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "daemon_process.hpp"
#include "heartbeat.hpp"
#include "room_recording.hpp"
#include "tests/sanitized.hpp"

namespace cornerd::system_test {
namespace {

/// And one client of the control socket. Under a sanitizer 31 readers of one process fall behind.
constexpr int kWatchers = test::kSanitized ? 3 : 31;
constexpr int kChanges = 6;

/// Reads everything and checks that nothing is missing.
struct Watcher {
  TestClient client;
  const Heartbeat* heartbeat;
  std::string room = {};  ///< of the newest MAP
  std::uint64_t seq = 0;
  int poses_in_map = 0;
  int maps = 0;
  int loads = 0;  ///< EVENT
  int unnamed = 0;

  void take(const json& message) {
    EXPECT_TRUE(!message.contains("dropped") || heartbeat->stood_still_lately()) << message;
    if (message["class"] == "MAP") {
      ++maps;
      poses_in_map = 0;
      room = message["rooms"][0]["name"];
    } else if (message["class"] == "EVENT") {
      loads += message["what"] == "map loaded" ? 1 : 0;
    } else if (message["class"] == "POSE") {
      take_pose(message);
    }
  }

  void take_pose(const json& pose) {
    const std::uint64_t now = pose["seq"];
    if (seq != 0) {
      EXPECT_EQ(now, seq + 1 + pose.value("dropped", 0u));
    }
    seq = now;
    ++poses_in_map;
    if (!pose.contains("room")) {
      ++unnamed;
    } else if (maps > 0) {
      EXPECT_EQ(pose["room"], room) << "MAP comes before the first POSE in it";
    }
  }
};

class SetMap : public DaemonTest {
 protected:
  SetMap() { write_map(folder_ / "other.json", "another"); }

  static json ask(TestClient& client, const std::string& request) {
    client.send(request + "\n");
    return next_where(client, [](const json& message) {
      return message["class"] == "OK" || message["class"] == "ERROR";
    });
  }
  static json set_file(TestClient& control, const std::string& file) {
    return ask(control, json({{"class", "SET_MAP"}, {"file", file}, {"id", file}}).dump());
  }
  static json poll_map(TestClient& client) {
    client.send(R"({"class":"POLL","classes":["MAP"]})"
                "\n");
    return next_of(client, "MAP");
  }
};

TEST_F(SetMap, ThirtyTwoClients_NobodyLosesAMessage) {
  const DaemonProcess daemon = start({"/lidar/speed=1"});
  const Heartbeat heartbeat;
  std::vector<Watcher> watchers;
  for (int i = 0; i < kWatchers; ++i) {
    watchers.push_back({connect(), &heartbeat});
    watchers.back().client.send(R"({"class":"WATCH","classes":["POSE","STATUS","EVENT","MAP"]})"
                                "\n");
  }
  TestClient control = connect("control.sock");
  EXPECT_EQ(next(control)["class"], "VERSION");
  // A line of each in turn: nobody waits until another one has read.
  const auto read_until_two_poses_in_map = [&](int map) {
    while (watchers.back().poses_in_map < 2 || watchers.back().maps < map) {
      for (Watcher& watcher : watchers) {
        const json message = next(watcher.client);
        ASSERT_TRUE(message.is_object()) << daemon.output();
        watcher.take(message);
      }
    }
  };
  for (int change = 0; change <= kChanges; ++change) {
    if (change > 0) {
      const std::string file = (folder_ / (change % 2 == 1 ? "other.json" : "map.json")).string();
      control.send(json({{"class", "SET_MAP"}, {"file", file}}).dump() + "\n");
    }
    read_until_two_poses_in_map(1 + change);
    if (HasFatalFailure()) return;
    if (change > 0) {
      EXPECT_EQ(next(control)["class"], "OK");
    }
  }
  for (const Watcher& watcher : watchers) {
    EXPECT_EQ(watcher.loads, kChanges);
    EXPECT_EQ(watcher.maps, 1 + kChanges);
    EXPECT_LE(watcher.unnamed, kChanges) << "a pose more than one scan is lost";
  }
}

TEST_F(SetMap, BadMap_RefusedWithReasonAndOldOneStays) {
  const DaemonProcess daemon = start();
  TestClient client = connect();
  next_of(client, "POSE");
  client.send(R"({"class":"WATCH","classes":["POSE","EVENT"]})"
              "\n");
  const json before = poll_map(client);
  std::ofstream(folder_ / "bad.json") << R"({ "format": "cornerd-map", "version": 1 })";
  TestClient control = connect("control.sock");
  const std::vector<std::pair<std::string, std::string>> refused = {
      {"bad.json", "bad.json: /walls: is missing"},
      {"none.json", "none.json: cannot be opened: No such file"},
      {"cornerd.json", "/format: must be \"cornerd-map\""},
      {"/etc/passwd", "SET_MAP: /file: must be below"}};
  for (const auto& [file, reason] : refused) {
    const json answer = set_file(control, file);
    EXPECT_EQ(answer["code"], "map") << answer;
    EXPECT_EQ(answer["id"], file);
    EXPECT_NE(answer["message"].get<std::string>().find(reason), std::string::npos) << answer;
    EXPECT_EQ(next_event(client, "map refused")["detail"], answer["message"]);
  }
  EXPECT_EQ(ask(control, R"({"class":"SET_MAP","name":"floor 2"})")["code"], "map");
  EXPECT_EQ(ask(client, R"({"class":"SET_MAP","file":"other.json"})")["code"], "read-only");
  EXPECT_EQ(poll_map(client), before);
  EXPECT_EQ(next_of(client, "POSE")["room"], "only");
}

TEST_F(SetMap, Hangup_BackToTheConfigsMap) {
  const DaemonProcess daemon = start();
  TestClient client = connect();
  client.send(R"({"class":"WATCH","classes":["MAP"]})"
              "\n");
  const json first = next_of(client, "MAP");
  EXPECT_EQ(first["name"], "test-room");
  EXPECT_EQ(first["hash"].get<std::string>().size(), 64u);
  EXPECT_EQ(first["walls"].size(), 7u);
  EXPECT_EQ(first["sigma"], 0.01);
  TestClient control = connect("control.sock");
  EXPECT_EQ(set_file(control, "other.json")["class"], "OK");
  const json second = next_of(client, "MAP");
  EXPECT_EQ(second["rooms"][0]["name"], "another");
  EXPECT_NE(second["hash"], first["hash"]);
  daemon.send_signal(SIGHUP);
  EXPECT_EQ(next_of(client, "MAP"), first);
}

/// Two maps to choose from: the robot starts at rest, then drives.
class AutoMap : public SetMap {
 protected:
  static constexpr int kScans = 60;

  AutoMap() {
    write_other_map(folder_ / "other.json");
    write_recording(folder_ / "scans.ndjson", kScans, /*drives=*/true);
  }
  DaemonProcess start_auto() {
    const json maps = {{{"name", "upper"}, {"file", (folder_ / "other.json").string()}},
                       {{"name", "ground"}, {"file", (folder_ / "map.json").string()}}};
    return start({"/maps=" + maps.dump(), "/map=auto", "/lidar/speed=2",
                  "/lidar/file=" + (folder_ / "scans.ndjson").string()});
  }
  /// Reads until the scans have chosen; returns the first POSE in the map.
  static json read_until_chosen(TestClient& client) {
    return next_of(client, "POSE", [](const json& pose) { return pose.contains("map"); });
  }
};

TEST_F(AutoMap, ScansOfADriveChoose_AmbiguousUntilThen) {
  const DaemonProcess daemon = start_auto();
  TestClient client = connect();
  client.send(R"({"class":"WATCH","classes":["POSE","MAP","EVENT","STATUS"]})"
              "\n");
  bool is_ambiguous = false;
  bool status_names_candidates = false;
  std::string map;
  const json pose = next_where(client, [&](const json& message) {
    if (message["class"] == "MAP") map = message["name"];
    if (message["class"] == "STATUS" && message["map"]["state"] == "ambiguous") {
      status_names_candidates = message["map"]["candidates"] == json({"ground"});
    }
    if (message["class"] != "POSE") return false;
    if (!message.contains("map") && message["state"] == "ambiguous") {
      is_ambiguous = true;
      EXPECT_EQ(map, "") << "MAP comes when the map is known";
      EXPECT_EQ(message["alternatives"][0]["map"], "ground");
    }
    return message.contains("map");
  });
  ASSERT_TRUE(pose.is_object()) << daemon.output();
  EXPECT_TRUE(is_ambiguous);
  EXPECT_TRUE(status_names_candidates);
  EXPECT_EQ(map, "ground");
  EXPECT_EQ(pose["map"], "ground");
  EXPECT_NEAR(pose["y"], kTrueY, 0.02);
  EXPECT_GT(pose["x"], kTrueX + 0.5);
}

TEST_F(AutoMap, SetMapAndSetPose_WhileItIsNotKnown) {
  const DaemonProcess daemon = start_auto();
  TestClient control = connect("control.sock");
  EXPECT_EQ(ask(control, R"({"class":"SET_POSE","x":0.8,"y":0.6,"theta":0.5})")["code"], "map");
  EXPECT_EQ(ask(control, R"({"class":"SET_MAP","name":"ground"})")["class"], "OK");
  TestClient client = connect();
  const json pose = read_until_chosen(client);
  EXPECT_EQ(pose["map"], "ground");
  EXPECT_EQ(ask(control, R"({"class":"SET_MAP","name":"auto"})")["class"], "OK");
  const json status = next_of(
      client, "STATUS", [](const json& message) { return message["map"]["state"] != "known"; });
  EXPECT_TRUE(status.is_object()) << "the scans choose again";
}

TEST_F(SetMap, WithoutLidar_WatchersGetTheMap) {
  const DaemonProcess daemon = start({"/lidar/driver=rplidar", "/lidar/device=/dev/no_such_lidar"});
  TestClient client = connect();
  client.send(R"({"class":"WATCH","classes":["MAP"]})"
              "\n");
  EXPECT_EQ(next_of(client, "MAP")["rooms"][0]["name"], "only");
  TestClient control = connect("control.sock");
  EXPECT_EQ(set_file(control, "other.json")["class"], "OK");
  EXPECT_EQ(next_of(client, "MAP")["rooms"][0]["name"], "another");
}

}  // namespace
}  // namespace cornerd::system_test
