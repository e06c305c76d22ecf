// SPDX-License-Identifier: MIT
#include "web/foxglove_session.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include <nlohmann/json.hpp>

namespace cornerd::web {
namespace {

using nlohmann::json;

const std::string kPoseLine =
    R"({"class":"POSE","seq":1,"t":1.5,"state":"fix","x":2,"y":3,"theta":1})";

class FoxgloveSessionTest : public ::testing::Test {
 protected:
  FoxgloveSessionTest() {
    while (session_.has_frame()) session_.take_frame();
  }
  /// The status message that waits; empty if none does.
  std::string told() {
    if (!session_.has_frame()) return {};
    const json frame = json::parse(session_.take_frame().bytes);
    return frame["op"] == "status" ? frame["message"] : json("another frame");
  }
  static std::string message(std::uint8_t channel, const std::string& text) {
    return std::string({1, static_cast<char>(channel), 0, 0, 0}) + text;
  }
  void advertise() {
    session_.on_text(
        R"({"op":"advertise","channels":[{"id":4,"topic":"/initialpose","encoding":"json","schemaName":"foxglove.PoseInFrame"}]})");
  }
  static std::string pose(const std::string& frame) {
    return R"({"frame_id":")" + frame +
           R"(","pose":{"position":{"x":1,"y":2,"z":0},"orientation":{"x":0,"y":0,"z":0.5,"w":0.8660254}}})";
  }
  FoxgloveSession session_{/*may_publish=*/true};
};

TEST(FoxgloveProtocol, BothNamesInAnyList) {
  EXPECT_EQ(foxglove_protocol("foxglove.websocket.v1"), "foxglove.websocket.v1");
  EXPECT_EQ(foxglove_protocol("x, foxglove.sdk.v1 ,y"), "foxglove.sdk.v1");
  for (const char* none : {"", "mqtt", "foxglove.sdk.v2", ",,,"})
    EXPECT_EQ(foxglove_protocol(none), "");
}

TEST(FoxgloveSession, Start_NamesServerAndChannels) {
  FoxgloveSession session(/*may_publish=*/false);
  const json info = json::parse(session.take_frame().bytes);
  EXPECT_EQ(info["op"], "serverInfo");
  EXPECT_TRUE(info["capabilities"].empty());
  EXPECT_EQ(json::parse(session.take_frame().bytes)["channels"].size(),
            foxglove::channels().size());
}

TEST_F(FoxgloveSessionTest, SubscribedChannels_GetTheirMessagesAlone) {
  session_.on_line(kPoseLine, 0);
  EXPECT_FALSE(session_.has_frame());
  session_.on_text(R"({"op":"subscribe","subscriptions":[{"id":9,"channelId":2}]})");
  session_.on_line(kPoseLine, 0);
  const FoxgloveSession::Frame frame = session_.take_frame();
  EXPECT_TRUE(frame.is_binary);
  EXPECT_EQ(frame.bytes.substr(0, 5), std::string({1, 9, 0, 0, 0}));
  EXPECT_EQ(json::parse(frame.bytes.substr(13))["frame_id"], "map");
  EXPECT_FALSE(session_.has_frame());
  session_.on_text(R"({"op":"unsubscribe","subscriptionIds":[9]})");
  session_.on_line(kPoseLine, 0);
  EXPECT_FALSE(session_.has_frame());
}

TEST_F(FoxgloveSessionTest, Walls_AskForTheMapOnce) {
  session_.on_text(R"({"op":"subscribe","subscriptions":[{"id":1,"channelId":4}]})");
  EXPECT_TRUE(session_.take_map_wanted());
  EXPECT_FALSE(session_.take_map_wanted());
}

TEST_F(FoxgloveSessionTest, InitialPose_IsSetPose) {
  EXPECT_EQ(session_.on_binary(message(4, pose("map"))), "") << "not advertised";
  advertise();
  const json request = json::parse(session_.on_binary(message(4, pose("map"))));
  EXPECT_EQ(request["class"], "SET_POSE");
  EXPECT_EQ(request["x"], 1);
  EXPECT_NEAR(request["theta"], core::kPi / 3, 1e-6);
  EXPECT_EQ(session_.on_binary(message(4, pose("odom"))), "");
  EXPECT_NE(told().find("frame_id"), std::string::npos);
  EXPECT_EQ(session_.on_binary(message(4, "{}")), "");
  EXPECT_NE(told().find("/pose/position/x"), std::string::npos);
}

TEST(FoxgloveSession, ReaderOnly_SetsNoPose) {
  FoxgloveSession session(/*may_publish=*/false);
  session.on_text(
      R"({"op":"advertise","channels":[{"id":4,"topic":"/initialpose","encoding":"json"}]})");
  EXPECT_EQ(session.on_binary(std::string({1, 4, 0, 0, 0}) + "{}"), "");
}

TEST_F(FoxgloveSessionTest, MalformedFrames_AreRefusedOrIgnored) {
  for (const char* text :
       {"", "[]", "{", "{\"op\":\"subscribe\",\"subscriptions\":[{}]}",
        "{\"op\":\"subscribe\",\"subscriptions\":[7]}",
        "{\"op\":\"subscribe\",\"subscriptions\":[{\"id\":1,\"channelId\":99}]}",
        "{\"op\":\"subscribe\",\"subscriptions\":[{\"id\":-1,\"channelId\":1}]}"}) {
    session_.on_text(text);
    EXPECT_NE(told(), "") << text;
  }
  for (const char* text : {"{}", "{\"op\":1}", "{\"op\":\"advertise\",\"channels\":[null]}"})
    session_.on_text(text);
  for (const std::string bytes : {"", "\x01", "\x02"}) EXPECT_EQ(session_.on_binary(bytes), "");
  EXPECT_FALSE(session_.has_frame());
}

}  // namespace
}  // namespace cornerd::web
