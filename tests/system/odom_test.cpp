// SPDX-License-Identifier: MIT
// ODOM: dead reckoning alone, which never jumps.
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <string>
#include <thread>

#include "daemon_process.hpp"

namespace cornerd::system_test {
namespace {

class Odom : public DaemonTest {
 protected:
  /// Rolls at 50 Hz during its lifetime, 20 counts a reading.
  std::jthread rolling_robot() {
    return std::jthread([control = connect("control.sock")](std::stop_token stop) mutable {
      for (int counts = 0; !stop.stop_requested(); counts += 20) {
        const std::string both = std::to_string(counts);
        control.send(R"({"class":"ODOMETRY","left":)" + both + R"(,"right":)" + both + "}\n");
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
      }
    });
  }
};

TEST_F(Odom, WithoutLidar_FollowsTheWheels) {
  const DaemonProcess daemon =
      start({"/lidar/driver=rplidar", "/lidar/device=" + (folder_ / "absent").string(),
             "/odometry/source=socket"});
  TestClient client = connect();
  client.send(R"({"class":"WATCH","classes":["ODOM"]})"
              "\n");
  const std::jthread robot = rolling_robot();
  const json first = next_of(client, "ODOM");
  ASSERT_TRUE(first.is_object()) << daemon.output();
  double x_m = first["x"];
  for (int i = 0; i < 50; ++i) {
    const json odom = next_of(client, "ODOM");
    EXPECT_GE(odom["x"].get<double>(), x_m);
    x_m = odom["x"];
    EXPECT_DOUBLE_EQ(odom["y"], 0);
  }
  EXPECT_GT(x_m, first["x"].get<double>());
  client.send(R"({"class":"POLL","classes":["ODOM"]})"
              "\n");
  EXPECT_EQ(next_of(client, "OK")["request"], "POLL");
}

TEST_F(Odom, Odometry_CanBeWatchedForARecording) {
  const DaemonProcess daemon =
      start({"/lidar/driver=rplidar", "/lidar/device=" + (folder_ / "absent").string(),
             "/odometry/source=socket"});
  TestClient client = connect();
  client.send(R"({"class":"WATCH","classes":["ODOMETRY"]})"
              "\n");
  const std::jthread robot = rolling_robot();
  double t_s = 0;
  int left = -1;
  for (int i = 0; i < 20; ++i) {
    const json reading = next_of(client, "ODOMETRY");
    ASSERT_TRUE(reading.is_object()) << daemon.output();
    EXPECT_GT(reading["t"].get<double>(), t_s);
    EXPECT_GT(reading["left"].get<int>(), left);
    EXPECT_EQ(reading["left"], reading["right"]);
    EXPECT_FALSE(reading.contains("gyro"));
    t_s = reading["t"];
    left = reading["left"];
  }
}

TEST_F(Odom, AnotherMapAndANewPose_AreNoJump) {
  const DaemonProcess daemon =
      start({"/lidar/speed=1", "/lidar/loop=true", "/odometry/source=socket"});
  TestClient client = connect();
  client.send(R"({"class":"WATCH","classes":["ODOM"]})"
              "\n");
  const std::jthread robot = rolling_robot();
  TestClient control = connect("control.sock");
  double x_m = next_of(client, "ODOM")["x"];
  for (int i = 0; i < 60; ++i) {
    if (i == 20) control.send("{\"class\":\"SET_MAP\",\"file\":\"map.json\"}\n");
    if (i == 40) control.send("{\"class\":\"SET_POSE\",\"x\":1,\"y\":1,\"theta\":1}\n");
    const json odom = next_of(client, "ODOM");
    ASSERT_TRUE(odom.is_object()) << daemon.output();
    // A slow reader loses lines, and a slow daemon readings: what is between is a step.
    EXPECT_GE(odom["x"].get<double>(), x_m) << odom;
    x_m = odom["x"];
  }
  EXPECT_GT(x_m, 0.05);
}

}  // namespace
}  // namespace cornerd::system_test
