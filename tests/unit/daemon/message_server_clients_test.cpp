// SPDX-License-Identifier: MIT
// Clients that are slow, leave, or are too many, and sockets that are removed.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "message_server_fixture.hpp"

namespace cornerd::daemon {
namespace {

using message::MessageClass;
using nlohmann::json;

TEST_F(MessageServerTest, ClientClosesSendingSide_StillAnswered) {
  server_.publish(MessageClass::kPose, pose(3));
  TestClient client = greeted(pose_path_);
  client.send(R"({"class":"POLL"})");  // no newline
  client.finish_sending();
  serve();
  EXPECT_EQ(next(client)["seq"], 3);
  EXPECT_EQ(next(client)["class"], "OK");
  server_.publish(MessageClass::kPose, pose(4));
  EXPECT_EQ(next(client)["seq"], 4) << "it may still read";
}

TEST_F(MessageServerTest, ClientDisconnects_Removed) {
  {
    TestClient client = greeted(pose_path_);
    EXPECT_EQ(server_.clients(), 1u);
  }
  serve();
  EXPECT_EQ(server_.clients(), 0u);
}

TEST_F(MessageServerTest, SlowClient_NewestLineAndNumberDropped) {
  TestClient sleeper = greeted(pose_path_);
  TestClient reader = greeted(pose_path_);
  constexpr int kPoses = 200;
  const std::string padding(400, ' ');  // as long as a real line
  for (int i = 1; i <= kPoses; ++i) {
    server_.publish(MessageClass::kPose,
                    "{\"class\":\"POSE\"," + padding + "\"seq\":" + std::to_string(i) + "}\n");
    EXPECT_EQ(next(reader)["seq"], i) << "the slow client must not delay the reader";
  }
  std::vector<int> seen;
  int dropped = 0;
  for (json line = next(sleeper); line != "nothing"; line = next(sleeper)) {
    seen.push_back(line["seq"]);
    dropped += line.value("dropped", 0);
    serve();
  }
  EXPECT_EQ(seen.back(), kPoses);
  EXPECT_EQ(static_cast<int>(seen.size()) + dropped, kPoses) << "every lost message is counted";
  EXPECT_LE(seen.size(), 8u) << "more would be seconds of stale poses";
  EXPECT_EQ(server_.dropped(), static_cast<std::uint64_t>(dropped));
}

TEST_F(MessageServerTest, LineLongerThanSocketBuffer_ArrivesWhole) {
  TestClient client = greeted(pose_path_);
  ask(client, R"({"class":"WATCH","classes":["SCAN"]})");
  const std::string text(100'000, 'r');
  server_.publish(MessageClass::kScan, "{\"class\":\"SCAN\",\"text\":\"" + text + "\"}\n");
  server_.publish(MessageClass::kScan, "{\"class\":\"SCAN\",\"text\":\"2\"}\n");
  server_.publish(MessageClass::kScan, "{\"class\":\"SCAN\",\"text\":\"3\"}\n");
  json line = "nothing";
  // One line takes many rounds of reading and writing.
  for (int i = 0; i < 1000 && line == "nothing"; ++i) {
    line = next(client);
    serve();
  }
  EXPECT_EQ(line["text"], text);
  line = next(client);
  EXPECT_EQ(line["text"], "3");
  EXPECT_EQ(line["dropped"], 1);
}

TEST_F(MessageServerTest, ClientRequestsWithoutReading_InputPaused) {
  TestClient client = greeted(pose_path_);
  std::string requests;
  for (int i = 0; i < 1000; ++i)
    requests += "{\"class\":\"POLL\",\"id\":" + std::to_string(i) + "}\n";
  client.send(requests.substr(0, 30'000));
  serve();
  // It gets all answers once it reads.
  int last = -1;
  for (int i = 0; i < 5000; ++i) {
    const json line = next(client);
    if (line != "nothing") {
      EXPECT_EQ(line["id"], last + 1) << "in order, none lost";
      last = line["id"];
    }
    serve();
  }
  EXPECT_GT(last, 900);
}

TEST_F(MessageServerTest, RemovedSocket_Restored) {
  TestClient before = greeted(pose_path_);
  std::vector<std::string> logged;
  const auto restore = [&] {
    server_.restore_sockets([&](const std::string& line) { logged.push_back(line); });
  };
  restore();
  EXPECT_TRUE(logged.empty());
  std::filesystem::remove(pose_path_);
  restore();
  ASSERT_EQ(logged.size(), 1u);
  EXPECT_THAT(logged.front(), ::testing::StartsWith(pose_path_.string()));
  TestClient after = greeted(pose_path_);
  server_.publish(MessageClass::kPose, pose(1));
  EXPECT_EQ(next(before)["class"], "POSE");
  EXPECT_EQ(next(after)["class"], "POSE");
}

TEST_F(MessageServerTest, UnrestorableSocket_LoggedOnce) {
  std::vector<std::string> logged;
  const auto restore = [&] {
    server_.restore_sockets([&](const std::string& line) { logged.push_back(line); });
  };
  // A file replaces the sockets' folder.
  const std::filesystem::path aside = folder_.path().string() + ".aside";
  std::filesystem::rename(folder_.path(), aside);
  std::ofstream(folder_.path()) << "in the way";
  restore();
  restore();
  EXPECT_EQ(logged.size(), 2u) << "once per socket";
  std::filesystem::remove(folder_.path());
  std::filesystem::rename(aside, folder_.path());
  restore();
  EXPECT_EQ(logged.size(), 2u) << "the sockets exist";
  greeted(pose_path_);
}

TEST_F(MessageServerTest, OdometryRefusedToAClientThatNeverReads_LaterLinesAreRead) {
  TestClient client = greeted(control_path_);
  for (int i = 0; i < 1000; ++i) {
    ASSERT_TRUE(client.send(R"({"class":"ODOMETRY","left":1.5})"
                            "\n"));
    if (i % 10 == 0) serve();
  }
  ASSERT_TRUE(client.send(R"({"class":"ODOMETRY","left":7,"right":7})"
                          "\n"));
  serve();
  ASSERT_EQ(readings_.size(), 1u);
  EXPECT_EQ(next(client)["class"], "ERROR") << "the first ones are answered";
}

TEST_F(MessageServerTest, SocketWithoutPermissions_LoggedOnceAndMadeAgainAfterRemoval) {
  std::vector<std::string> logged;
  const auto restore = [&] {
    server_.restore_sockets([&](const std::string& line) { logged.push_back(line); });
  };
  std::filesystem::permissions(control_path_, std::filesystem::perms::none);
  restore();
  restore();
  ASSERT_EQ(logged.size(), 1u);
  EXPECT_THAT(logged.front(), ::testing::StartsWith(control_path_.string() + ": its mode"));
  std::filesystem::remove(control_path_);
  restore();
  greeted(control_path_);
}

TEST_F(MessageServerTest, TooManyClients_Refused) {
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

TEST_F(MessageServerTest, ControlClient_PoseClientsFull_NewestPoseClientEvicted) {
  std::vector<TestClient> clients;
  for (std::size_t i = 0; i < MessageServer::kMaxClients; ++i) {
    clients.push_back(greeted(pose_path_));
  }
  std::vector<TestClient> controllers;
  for (std::size_t i = 0; i < MessageServer::kReservedControlClients; ++i) {
    controllers.push_back(greeted(control_path_));
    EXPECT_EQ(next(clients.back())["code"], "too-many-clients")
        << "the newest pose client is disconnected";
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
