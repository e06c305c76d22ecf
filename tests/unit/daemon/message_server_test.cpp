// SPDX-License-Identifier: MIT
#include "daemon/message_server.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "test_client.hpp"
#include "tests/temporary_folder.hpp"

namespace cornerd::daemon {
namespace {

using message::MessageClass;
using nlohmann::json;

class MessageServerTest : public ::testing::Test {
 protected:
  MessageServerTest() {
    server_.listen(pose_path_, SocketRole::kPose);
    server_.listen(control_path_, SocketRole::kControl);
  }

  /// Until nothing is left to do.
  void serve() {
    for (int i = 0; i < 20; ++i) loop_.run_once(0);
  }

  TestClient connect(const std::filesystem::path& path) {
    TestClient client(path);
    serve();
    return client;
  }

  /// A connection that has read its VERSION.
  TestClient greeted(const std::filesystem::path& path) {
    TestClient client = connect(path);
    EXPECT_EQ(next(client)["class"], "VERSION");
    return client;
  }

  static json next(TestClient& client) {
    const auto line = client.read_line(0);
    return line ? json::parse(*line) : json("nothing");
  }

  json ask(TestClient& client, const std::string& request) {
    EXPECT_TRUE(client.send(request + "\n"));
    serve();
    return next(client);
  }

  static std::string pose(int seq) {
    return "{\"class\":\"POSE\",\"seq\":" + std::to_string(seq) + "}\n";
  }

  test::TemporaryFolder folder_;
  const std::filesystem::path pose_path_ = folder_ / "pose.sock";
  const std::filesystem::path control_path_ = folder_ / "control.sock";
  EventLoop loop_;
  int relocalizations_ = 0;
  std::vector<core::Pose2> given_;
  std::vector<message::OdometryReading> readings_;
  int publisher_ = -1;  ///< the connection whose readings are taken
  MessageServer server_{
      loop_,
      "1.2.3",
      {[this] { ++relocalizations_; },
       [this](const message::SetPoseRequest& request) { given_.push_back(request.T_map_base); },
       [this](const message::OdometryReading& reading, int connection) {
         readings_.push_back(reading);
         if (publisher_ < 0) publisher_ = connection;
         return publisher_ == connection;
       },
       [this](int connection) {
         if (publisher_ == connection) publisher_ = -1;
       }}};
};

TEST_F(MessageServerTest, NewClient_GetsVersionThenPoseAndStatusAlone) {
  TestClient client = greeted(pose_path_);
  server_.publish(MessageClass::kScan, "{\"class\":\"SCAN\"}\n");
  server_.publish(MessageClass::kPose, pose(1));
  server_.publish(MessageClass::kStatus, "{\"class\":\"STATUS\"}\n");
  EXPECT_EQ(next(client)["class"], "POSE");
  EXPECT_EQ(next(client)["class"], "STATUS");
  EXPECT_EQ(next(client), "nothing");
}

TEST_F(MessageServerTest, Newcomer_GetsTheNewestStatusButNoOldPose) {
  server_.publish(MessageClass::kStatus, "{\"class\":\"STATUS\",\"n\":1}\n");
  server_.publish(MessageClass::kPose, pose(1));
  TestClient client = greeted(pose_path_);
  EXPECT_EQ(next(client)["n"], 1);
  EXPECT_EQ(next(client), "nothing");
}

TEST_F(MessageServerTest, Watch_ChoosesTheClasses) {
  TestClient client = greeted(pose_path_);
  EXPECT_EQ(ask(client, R"({"class":"WATCH","classes":["SCAN"],"id":5})"),
            json({{"class", "OK"}, {"request", "WATCH"}, {"id", 5}}));
  EXPECT_TRUE(server_.is_watched(MessageClass::kScan));
  EXPECT_FALSE(server_.is_watched(MessageClass::kPose));
  server_.publish(MessageClass::kPose, pose(1));
  server_.publish(MessageClass::kScan, "{\"class\":\"SCAN\"}\n");
  EXPECT_EQ(next(client)["class"], "SCAN");
}

TEST_F(MessageServerTest, WatchOfOneClient_IsItsOwn) {
  TestClient first = greeted(pose_path_);
  TestClient second = greeted(pose_path_);
  ask(first, R"({"class":"WATCH","classes":[]})");
  server_.publish(MessageClass::kPose, pose(1));
  EXPECT_EQ(next(first), "nothing");
  EXPECT_EQ(next(second)["class"], "POSE");
}

TEST_F(MessageServerTest, BadLine_GetsAnErrorAndCostsNothingElse) {
  TestClient client = greeted(pose_path_);
  EXPECT_EQ(ask(client, "what?")["code"], "json");
  const json unknown = ask(client, R"({"class":"FLY","id":"a"})");
  EXPECT_EQ(unknown["code"], "class");
  EXPECT_EQ(unknown["id"], "a");
  server_.publish(MessageClass::kPose, pose(1));
  EXPECT_EQ(next(client)["class"], "POSE");
}

TEST_F(MessageServerTest, LineTooLong_ClosesThatClientAlone) {
  TestClient client = greeted(pose_path_);
  TestClient other = greeted(pose_path_);
  // In pieces that the socket takes without a reader.
  for (int i = 0; i < 5; ++i) {
    client.send(std::string(16 * 1024, 'x'));
    serve();
  }
  EXPECT_EQ(next(client)["code"], "too-long");
  EXPECT_EQ(client.read_line(0), std::nullopt);
  EXPECT_TRUE(client.has_ended());
  server_.publish(MessageClass::kPose, pose(1));
  EXPECT_EQ(next(other)["class"], "POSE");
}

TEST_F(MessageServerTest, Poll_GetsTheNewestPoseAndStatusOnEitherSocket) {
  for (const auto& path : {pose_path_, control_path_}) {
    server_.publish(MessageClass::kPose, pose(7));
    TestClient client = greeted(path);
    EXPECT_EQ(ask(client, R"({"class":"POLL","id":1})")["seq"], 7);
    EXPECT_EQ(next(client), json({{"class", "OK"}, {"request", "POLL"}, {"id", 1}}))
        << "there was no STATUS yet";
  }
}

TEST_F(MessageServerTest, Relocalize_IsForTheControlSocket) {
  TestClient reader = greeted(pose_path_);
  EXPECT_EQ(ask(reader, R"({"class":"RELOCALIZE"})")["code"], "read-only");
  EXPECT_EQ(relocalizations_, 0);
  TestClient controller = greeted(control_path_);
  EXPECT_EQ(ask(controller, R"({"class":"RELOCALIZE"})")["class"], "OK");
  EXPECT_EQ(relocalizations_, 1);
}

TEST_F(MessageServerTest, SetPose_IsForTheControlSocket) {
  TestClient reader = greeted(pose_path_);
  const char* request = R"({"class":"SET_POSE","x":1,"y":2,"theta":0.5,"id":7})";
  EXPECT_EQ(ask(reader, request)["code"], "read-only");
  EXPECT_TRUE(given_.empty());
  TestClient controller = greeted(control_path_);
  EXPECT_EQ(ask(controller, request)["class"], "OK");
  ASSERT_EQ(given_.size(), 1U);
  EXPECT_EQ(given_[0].y_m, 2);
}

TEST_F(MessageServerTest, Odometry_IsTakenWithoutAnAnswer) {
  TestClient reader = greeted(pose_path_);
  EXPECT_EQ(ask(reader, R"({"class":"ODOMETRY","left":1,"right":2})")["code"], "read-only");
  TestClient controller = greeted(control_path_);
  controller.send("{\"class\":\"ODOMETRY\",\"t\":5,\"left\":1,\"right\":2,\"gyro\":0.1}\n");
  // The next answer is that of the next request.
  EXPECT_EQ(ask(controller, R"({"class":"RELOCALIZE"})")["request"], "RELOCALIZE");
  ASSERT_EQ(readings_.size(), 1U);
  EXPECT_EQ(readings_[0].t_ns, 5 * core::kNsPerSecond);
  EXPECT_EQ(readings_[0].right, 2);
  EXPECT_EQ(readings_[0].gyro_rad_s, 0.1);
  EXPECT_EQ(ask(controller, R"({"class":"ODOMETRY","left":"x"})")["code"], "field");
}

TEST_F(MessageServerTest, OdometryOfASecondClient_IsToldWhyUntilTheFirstHasGone) {
  const std::string line = R"({"class":"ODOMETRY","left":1,"right":2})";
  TestClient second = greeted(control_path_);
  {
    TestClient first = greeted(control_path_);
    EXPECT_EQ(ask(first, line), "nothing");
    EXPECT_EQ(ask(second, line)["code"], "second-client");
    EXPECT_EQ(ask(first, line), "nothing");
  }
  serve();
  EXPECT_EQ(ask(second, line), "nothing");
}

TEST_F(MessageServerTest, WhatNobodyTakes_IsRefusedClearly) {
  const std::filesystem::path path = folder_ / "other.sock";
  MessageServer server{loop_, "1.2.3", {[] {}}};
  server.listen(path, SocketRole::kControl);
  TestClient client = greeted(path);
  EXPECT_EQ(ask(client, R"({"class":"SET_POSE","x":0,"y":0,"theta":0})")["code"], "unsupported");
  EXPECT_EQ(ask(client, R"({"class":"ODOMETRY","left":0,"right":0})")["code"], "unsupported");
}

TEST_F(MessageServerTest, ClientThatOnlyAsks_GetsItsAnswerAfterItsLastWord) {
  server_.publish(MessageClass::kPose, pose(3));
  TestClient client = greeted(pose_path_);
  client.send(R"({"class":"POLL"})");  // no newline
  client.finish_sending();
  serve();
  EXPECT_EQ(next(client)["seq"], 3);
  EXPECT_EQ(next(client)["class"], "OK");
  server_.publish(MessageClass::kPose, pose(4));
  EXPECT_EQ(next(client)["seq"], 4) << "it may go on reading";
}

TEST_F(MessageServerTest, ClientThatLeaves_IsForgotten) {
  {
    TestClient client = greeted(pose_path_);
    EXPECT_EQ(server_.clients(), 1u);
  }
  serve();
  EXPECT_EQ(server_.clients(), 0u);
}

TEST_F(MessageServerTest, ClientThatDoesNotRead_GetsTheNewestAndIsToldWhatItLost) {
  TestClient sleeper = greeted(pose_path_);
  TestClient reader = greeted(pose_path_);
  constexpr int kPoses = 200;
  const std::string padding(400, ' ');  // as long as a real one
  for (int i = 1; i <= kPoses; ++i) {
    server_.publish(MessageClass::kPose,
                    "{\"class\":\"POSE\"," + padding + "\"seq\":" + std::to_string(i) + "}\n");
    EXPECT_EQ(next(reader)["seq"], i) << "the reader is delayed by nobody";
  }
  std::vector<int> seen;
  int dropped = 0;
  for (json line = next(sleeper); line != "nothing"; line = next(sleeper)) {
    seen.push_back(line["seq"]);
    dropped += line.value("dropped", 0);
    serve();
  }
  EXPECT_EQ(seen.back(), kPoses);
  EXPECT_EQ(static_cast<int>(seen.size()) + dropped, kPoses) << "every loss is told";
  EXPECT_LE(seen.size(), 8u) << "more would be seconds of stale poses";
  EXPECT_EQ(server_.dropped(), static_cast<std::uint64_t>(dropped));
}

TEST_F(MessageServerTest, LineLongerThanTheSocketTakes_ArrivesWhole) {
  TestClient client = greeted(pose_path_);
  ask(client, R"({"class":"WATCH","classes":["SCAN"]})");
  const std::string text(100'000, 'r');
  server_.publish(MessageClass::kScan, "{\"class\":\"SCAN\",\"text\":\"" + text + "\"}\n");
  server_.publish(MessageClass::kScan, "{\"class\":\"SCAN\",\"text\":\"2\"}\n");
  server_.publish(MessageClass::kScan, "{\"class\":\"SCAN\",\"text\":\"3\"}\n");
  json line = "nothing";
  // One line takes many turns of reading here and writing there.
  for (int i = 0; i < 1000 && line == "nothing"; ++i) {
    line = next(client);
    serve();
  }
  EXPECT_EQ(line["text"], text);
  line = next(client);
  EXPECT_EQ(line["text"], "3");
  EXPECT_EQ(line["dropped"], 1);
}

TEST_F(MessageServerTest, ClientThatAsksWithoutReading_IsNoLongerListenedTo) {
  TestClient client = greeted(pose_path_);
  std::string requests;
  for (int i = 0; i < 1000; ++i)
    requests += "{\"class\":\"POLL\",\"id\":" + std::to_string(i) + "}\n";
  client.send(requests.substr(0, 30'000));
  serve();
  // It gets all its answers once it reads.
  int last = -1;
  for (int i = 0; i < 5000; ++i) {
    const json line = next(client);
    if (line != "nothing") {
      EXPECT_EQ(line["id"], last + 1) << "in order, and none is lost";
      last = line["id"];
    }
    serve();
  }
  EXPECT_GT(last, 900);
}

TEST_F(MessageServerTest, SocketThatSomebodyRemoved_IsMadeAgain) {
  TestClient before = greeted(pose_path_);
  std::vector<std::string> told;
  const auto restore = [&] {
    server_.restore_sockets([&](const std::string& line) { told.push_back(line); });
  };
  restore();
  EXPECT_TRUE(told.empty());
  std::filesystem::remove(pose_path_);
  restore();
  ASSERT_EQ(told.size(), 1u);
  EXPECT_THAT(told.front(), ::testing::StartsWith(pose_path_.string()));
  TestClient after = greeted(pose_path_);
  server_.publish(MessageClass::kPose, pose(1));
  EXPECT_EQ(next(before)["class"], "POSE");
  EXPECT_EQ(next(after)["class"], "POSE");
}

TEST_F(MessageServerTest, SocketThatCannotBeMadeAgain_IsToldOfOnce) {
  std::vector<std::string> told;
  const auto restore = [&] {
    server_.restore_sockets([&](const std::string& line) { told.push_back(line); });
  };
  // A file in the place of their folder.
  const std::filesystem::path aside = folder_.path().string() + ".aside";
  std::filesystem::rename(folder_.path(), aside);
  std::ofstream(folder_.path()) << "in the way";
  restore();
  restore();
  EXPECT_EQ(told.size(), 2u) << "of each socket once";
  std::filesystem::remove(folder_.path());
  std::filesystem::rename(aside, folder_.path());
  restore();
  EXPECT_EQ(told.size(), 2u) << "they are there";
  greeted(pose_path_);
}

TEST_F(MessageServerTest, MoreClientsThanAreServed_AreToldSo) {
  TestClient controller = greeted(control_path_);
  std::vector<TestClient> clients;
  for (std::size_t i = 1; i < MessageServer::kMaxClients; ++i) {
    clients.push_back(greeted(pose_path_));
  }
  TestClient refused = connect(pose_path_);
  EXPECT_EQ(next(refused)["code"], "too-many-clients");
  EXPECT_EQ(refused.read_line(0), std::nullopt);
  EXPECT_TRUE(refused.has_ended());
  EXPECT_EQ(server_.clients(), MessageServer::kMaxClients);
}

TEST_F(MessageServerTest, ControlClient_FindsRoomWhereTheListenersHaveTakenIt) {
  std::vector<TestClient> clients;
  for (std::size_t i = 0; i < MessageServer::kMaxClients; ++i) {
    clients.push_back(greeted(pose_path_));
  }
  std::vector<TestClient> controllers;
  for (std::size_t i = 0; i < MessageServer::kReservedControlClients; ++i) {
    controllers.push_back(greeted(control_path_));
    EXPECT_EQ(next(clients.back())["code"], "too-many-clients") << "the newest goes";
    EXPECT_EQ(clients.back().read_line(0), std::nullopt);
    EXPECT_TRUE(clients.back().has_ended());
    clients.pop_back();
  }
  EXPECT_EQ(server_.clients(), MessageServer::kMaxClients);
  TestClient refused = connect(control_path_);
  EXPECT_EQ(next(refused)["code"], "too-many-clients");
  server_.publish(MessageClass::kPose, pose(1));
  for (TestClient& client : clients) EXPECT_EQ(next(client)["class"], "POSE");
}

}  // namespace
}  // namespace cornerd::daemon
