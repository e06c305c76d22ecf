// SPDX-License-Identifier: MIT
#include "daemon/message_server.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <optional>
#include <string>

#include "message_server_fixture.hpp"

namespace cornerd::daemon {
namespace {

using message::MessageClass;
using nlohmann::json;

TEST_F(MessageServerTest, NewClient_VersionThenPoseAndStatusOnly) {
  TestClient client = greeted(pose_path_);
  server_.publish(MessageClass::kScan, "{\"class\":\"SCAN\"}\n");
  server_.publish(MessageClass::kPose, pose(1));
  server_.publish(MessageClass::kStatus, "{\"class\":\"STATUS\"}\n");
  EXPECT_EQ(next(client)["class"], "POSE");
  EXPECT_EQ(next(client)["class"], "STATUS");
  EXPECT_EQ(next(client), "nothing");
}

TEST_F(MessageServerTest, NewClient_NewestStatusAndNoOldPose) {
  server_.publish(MessageClass::kStatus, "{\"class\":\"STATUS\",\"n\":1}\n");
  server_.publish(MessageClass::kPose, pose(1));
  TestClient client = greeted(pose_path_);
  EXPECT_EQ(next(client)["n"], 1);
  EXPECT_EQ(next(client), "nothing");
}

TEST_F(MessageServerTest, Watch_Request_SelectsClasses) {
  TestClient client = greeted(pose_path_);
  EXPECT_EQ(ask(client, R"({"class":"WATCH","classes":["SCAN"],"id":5})"),
            json({{"class", "OK"}, {"request", "WATCH"}, {"id", 5}}));
  EXPECT_TRUE(server_.is_watched(MessageClass::kScan));
  EXPECT_FALSE(server_.is_watched(MessageClass::kPose));
  server_.publish(MessageClass::kPose, pose(1));
  server_.publish(MessageClass::kScan, "{\"class\":\"SCAN\"}\n");
  EXPECT_EQ(next(client)["class"], "SCAN");
}

TEST_F(MessageServerTest, Watch_OneClient_OthersUnaffected) {
  TestClient first = greeted(pose_path_);
  TestClient second = greeted(pose_path_);
  ask(first, R"({"class":"WATCH","classes":[]})");
  server_.publish(MessageClass::kPose, pose(1));
  EXPECT_EQ(next(first), "nothing");
  EXPECT_EQ(next(second)["class"], "POSE");
}

TEST_F(MessageServerTest, MalformedLine_ErrorAndConnectionStays) {
  TestClient client = greeted(pose_path_);
  EXPECT_EQ(ask(client, "what?")["code"], "json");
  const json unknown = ask(client, R"({"class":"FLY","id":"a"})");
  EXPECT_EQ(unknown["code"], "class");
  EXPECT_EQ(unknown["id"], "a");
  server_.publish(MessageClass::kPose, pose(1));
  EXPECT_EQ(next(client)["class"], "POSE");
}

TEST_F(MessageServerTest, TooLongLine_OnlyThatClientClosed) {
  TestClient client = greeted(pose_path_);
  TestClient other = greeted(pose_path_);
  // In pieces that fit the socket's buffer.
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

TEST_F(MessageServerTest, Poll_EitherSocket_NewestPoseAndStatus) {
  for (const auto& path : {pose_path_, control_path_}) {
    server_.publish(MessageClass::kPose, pose(7));
    TestClient client = greeted(path);
    EXPECT_EQ(ask(client, R"({"class":"POLL","id":1})")["seq"], 7);
    EXPECT_EQ(next(client), json({{"class", "OK"}, {"request", "POLL"}, {"id", 1}}))
        << "there was no STATUS yet";
  }
}

TEST_F(MessageServerTest, Poll_OfMap_NewestMapOnly) {
  server_.publish(MessageClass::kPose, pose(7));
  server_.publish(MessageClass::kMap, "{\"class\":\"MAP\",\"name\":\"a\"}\n");
  TestClient client = greeted(pose_path_);
  EXPECT_EQ(ask(client, R"({"class":"POLL","classes":["MAP"]})")["name"], "a");
  EXPECT_EQ(next(client)["class"], "OK");
  EXPECT_EQ(next(client), "nothing");
}

TEST_F(MessageServerTest, WatchOfMap_NewestMapAtOnceAndEachNewOne) {
  server_.publish(MessageClass::kMap, "{\"class\":\"MAP\",\"name\":\"a\"}\n");
  TestClient other = greeted(pose_path_);
  TestClient client = greeted(pose_path_);
  EXPECT_EQ(ask(client, R"({"class":"WATCH","classes":["MAP"]})")["class"], "OK");
  EXPECT_EQ(next(client)["name"], "a");
  server_.publish(MessageClass::kMap, "{\"class\":\"MAP\",\"name\":\"b\"}\n");
  EXPECT_EQ(next(client)["name"], "b");
  EXPECT_EQ(next(other), "nothing") << "it does not watch MAP";
}

TEST_F(MessageServerTest, SetMap_PoseSocket_Refused) {
  TestClient reader = greeted(pose_path_);
  EXPECT_EQ(ask(reader, R"({"class":"SET_MAP","name":"b"})")["code"], "read-only");
  EXPECT_TRUE(maps_.empty());
}

TEST_F(MessageServerTest, SetMap_AnsweredWhenLoaded) {
  TestClient other = greeted(control_path_);
  TestClient client = greeted(control_path_);
  EXPECT_EQ(ask(client, R"({"class":"SET_MAP","name":"b","id":3})"), "nothing");
  EXPECT_EQ(ask(client, R"({"class":"SET_MAP","name":"c","id":"x"})"), "nothing");
  EXPECT_THAT(maps_, ::testing::ElementsAre("b", "c"));
  server_.answer_later(tickets_.at(0), std::nullopt);
  server_.answer_later(tickets_.at(1), message::RequestError{"map", "c.json: no walls"});
  EXPECT_EQ(next(client), json({{"class", "OK"}, {"request", "SET_MAP"}, {"id", 3}}));
  const json error = next(client);
  EXPECT_EQ(error["code"], "map");
  EXPECT_EQ(error["message"], "c.json: no walls");
  EXPECT_EQ(error["id"], "x");
  EXPECT_EQ(next(other), "nothing");
}

TEST_F(MessageServerTest, SetMap_ClientHasLeft_NobodyElseAnswered) {
  {
    TestClient client = greeted(control_path_);
    ask(client, R"({"class":"SET_MAP","name":"b"})");
  }
  serve();
  TestClient successor = greeted(control_path_);  // of the same descriptor
  server_.answer_later(tickets_.at(0), std::nullopt);
  EXPECT_EQ(next(successor), "nothing");
}

TEST_F(MessageServerTest, SetMap_TooManyWait_Busy) {
  takes_maps_ = false;
  TestClient client = greeted(control_path_);
  EXPECT_EQ(ask(client, R"({"class":"SET_MAP","name":"b"})")["code"], "busy");
}

TEST_F(MessageServerTest, Relocalize_PoseSocket_Refused) {
  TestClient reader = greeted(pose_path_);
  EXPECT_EQ(ask(reader, R"({"class":"RELOCALIZE"})")["code"], "read-only");
  EXPECT_EQ(relocalizations_, 0);
  TestClient controller = greeted(control_path_);
  EXPECT_EQ(ask(controller, R"({"class":"RELOCALIZE"})")["class"], "OK");
  EXPECT_EQ(relocalizations_, 1);
}

TEST_F(MessageServerTest, SetPose_PoseSocket_Refused) {
  TestClient reader = greeted(pose_path_);
  const char* request = R"({"class":"SET_POSE","x":1,"y":2,"theta":0.5,"id":7})";
  EXPECT_EQ(ask(reader, request)["code"], "read-only");
  EXPECT_TRUE(given_.empty());
  TestClient controller = greeted(control_path_);
  EXPECT_EQ(ask(controller, request)["class"], "OK");
  ASSERT_EQ(given_.size(), 1U);
  EXPECT_EQ(given_[0].y_m, 2);
}

TEST_F(MessageServerTest, SetPose_RefusedByTheDaemon_ErrorWithItsReason) {
  TestClient controller = greeted(control_path_);
  const auto error = ask(controller, R"({"class":"SET_POSE","x":2000,"y":2,"theta":0,"id":8})");
  EXPECT_EQ(error["class"], "ERROR");
  EXPECT_EQ(error["code"], "outside");
  EXPECT_EQ(error["message"], "too far");
  EXPECT_EQ(error["id"], 8);
}

TEST_F(MessageServerTest, Odometry_ControlSocket_AcceptedWithoutAnswer) {
  TestClient reader = greeted(pose_path_);
  EXPECT_EQ(ask(reader, R"({"class":"ODOMETRY","left":1,"right":2})")["code"], "read-only");
  TestClient controller = greeted(control_path_);
  controller.send("{\"class\":\"ODOMETRY\",\"t\":5,\"left\":1,\"right\":2,\"gyro\":0.1}\n");
  // ODOMETRY has no answer, so the next line answers the next request.
  EXPECT_EQ(ask(controller, R"({"class":"RELOCALIZE"})")["request"], "RELOCALIZE");
  ASSERT_EQ(readings_.size(), 1U);
  EXPECT_EQ(readings_[0].t_ns, 5 * core::kNsPerSecond);
  EXPECT_EQ(readings_[0].right, 2);
  EXPECT_EQ(readings_[0].gyro_rad_s, 0.1);
  EXPECT_EQ(ask(controller, R"({"class":"ODOMETRY","left":"x"})")["code"], "field");
}

TEST_F(MessageServerTest, OdometryThatIsNoRequest_IsCountedAsRefused) {
  TestClient controller = greeted(control_path_);
  for (const char* line : {"ODOMETRY 1 2 3", R"({"class":"ODOM","left":1,"right":2})",
                           R"({"class":"odometry","left":1})"}) {
    const std::size_t before = refusals_.size();
    EXPECT_EQ(ask(controller, line)["class"], "ERROR");
    EXPECT_EQ(refusals_.size(), before + 1) << line;
  }
  ask(controller, R"({"class":"FLY"})");
  EXPECT_EQ(refusals_.size(), 3U);
}

TEST_F(MessageServerTest, Odometry_SecondClient_ErrorUntilFirstDisconnects) {
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

TEST_F(MessageServerTest, RequestWithoutHandler_Unsupported) {
  const std::filesystem::path path = folder_ / "other.sock";
  MessageServer server{loop_, "1.2.3", {[] {}}};
  server.listen(path, SocketRole::kControl);
  TestClient client = greeted(path);
  EXPECT_EQ(ask(client, R"({"class":"SET_POSE","x":0,"y":0,"theta":0})")["code"], "unsupported");
  EXPECT_EQ(ask(client, R"({"class":"ODOMETRY","left":0,"right":0})")["code"], "unsupported");
}

}  // namespace
}  // namespace cornerd::daemon
