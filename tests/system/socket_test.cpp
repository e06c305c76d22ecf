// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "daemon_process.hpp"
#include "room_recording.hpp"

namespace cornerd::system_test {
namespace {

class Socket : public DaemonTest {};

TEST_F(Socket, NewClient_VersionThenCorrectPoses) {
  const DaemonProcess daemon = start();
  TestClient client = connect();
  const json version = next(client);
  EXPECT_EQ(version["class"], "VERSION");
  EXPECT_EQ(version["program"], "cornerd");
  const json pose = next_of(client, "POSE");
  ASSERT_TRUE(pose["state"] == "fix" || pose["state"] == "tracking") << pose;
  EXPECT_NEAR(pose["x"].get<double>(), kTrueX, 0.01);
  EXPECT_NEAR(pose["y"].get<double>(), kTrueY, 0.01);
  EXPECT_NEAR(pose["theta"].get<double>(), kTrueTheta, 0.01);
  EXPECT_EQ(pose["room"], "only");
  EXPECT_GT(pose["cov"]["xx"].get<double>(), 0);
  // A state that lasted for milliseconds is published too, before this one.
  const json status = next_of(
      client, "STATUS", [](const json& message) { return message["lidar"]["state"] != "opening"; });
  EXPECT_EQ(status["lidar"]["state"], "running");
}

TEST_F(Socket, EveryScan_HasOnePose) {
  const DaemonProcess daemon = start();
  TestClient client = connect();
  std::uint64_t last = next_of(client, "POSE")["seq"];
  for (int i = 0; i < 20; ++i) {
    const json pose = next_of(client, "POSE");
    EXPECT_EQ(pose["seq"].get<std::uint64_t>(), last + 1 + pose.value("dropped", 0u));
    last = pose["seq"];
  }
}

TEST_F(Socket, Watch_Request_ChangesClasses) {
  const DaemonProcess daemon = start();
  TestClient client = connect();
  client.send(R"({"class":"WATCH","classes":["SCAN","BREAKPOINTS"],"id":"w"})"
              "\n");
  EXPECT_EQ(next_of(client, "OK")["id"], "w");
  const json scan = next_of(client, "SCAN");
  EXPECT_EQ(scan["ranges"].size(), 720u);
  const json points = next_of(client, "BREAKPOINTS")["points"];
  EXPECT_GT(points.size(), 3u);
  for (int i = 0; i < 10; ++i) {
    const json message = next(client);
    EXPECT_TRUE(message["class"] == "SCAN" || message["class"] == "BREAKPOINTS") << message;
  }
}

TEST_F(Socket, MalformedLine_ErrorAndConnectionStays) {
  const DaemonProcess daemon = start();
  TestClient client = connect();
  client.send("\xff\xfe{]\n{\"class\":\"WATCH\",\"classes\":[\"NOPE\"],\"id\":3}\n");
  EXPECT_EQ(next_of(client, "ERROR")["code"], "json");
  const json error = next_of(client, "ERROR");
  EXPECT_EQ(error["id"], 3);
  EXPECT_EQ(error["request"], "WATCH");
  EXPECT_EQ(next_of(client, "POSE")["class"], "POSE");
}

TEST_F(Socket, LineOver64KiB_OnlyThatClientClosed) {
  const DaemonProcess daemon = start();
  TestClient other = connect();
  TestClient client = connect();
  client.send(std::string(80 * 1024, 'x'));
  while (next(client).is_object()) {
  }
  EXPECT_TRUE(client.has_ended());
  EXPECT_EQ(next_of(other, "POSE")["class"], "POSE");
}

TEST_F(Socket, Relocalize_AnsweredAndPosesContinue) {
  const DaemonProcess daemon = start();
  TestClient reader = connect();
  next_of(reader, "POSE");
  TestClient controller = connect("control.sock");
  controller.send(R"({"class":"RELOCALIZE","id":1})"
                  "\n");
  EXPECT_EQ(next_of(controller, "OK")["request"], "RELOCALIZE");
  EXPECT_EQ(next_of(reader, "POSE")["class"], "POSE");
}

TEST_F(Socket, SetPoseOutsideOfTheMap_RefusedWithItsExtent) {
  const DaemonProcess daemon = start();
  TestClient controller = connect("control.sock");
  controller.send(R"({"class":"SET_POSE","x":90,"y":1,"theta":0,"id":1})"
                  "\n");
  const json error = next_of(controller, "ERROR");
  EXPECT_EQ(error["code"], "outside");
  EXPECT_NE(error["message"].get<std::string>().find("to 2.4"), std::string::npos) << error;
  controller.send(R"({"class":"SET_POSE","x":0.8,"y":0.5,"theta":0,"id":2})"
                  "\n");
  EXPECT_EQ(next_of(controller, "OK")["id"], 2);
}

TEST_F(Socket, SecondInstance_RefusedAndFirstUnaffected) {
  const DaemonProcess daemon = start();
  TestClient client = connect();
  const Result second = run({"--config", config()});
  EXPECT_EQ(second.exit_code, 1);
  EXPECT_NE(second.output.find("another cornerd listens on this socket"), std::string::npos)
      << second.output;
  EXPECT_EQ(next_of(client, "POSE")["class"], "POSE");
  EXPECT_TRUE(connect().is_connected());
}

}  // namespace
}  // namespace cornerd::system_test
