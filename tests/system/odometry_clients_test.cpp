// SPDX-License-Identifier: MIT
// Controllers that send ODOMETRY to the built daemon.
#include <gtest/gtest.h>

#include <chrono>
#include <string>
#include <thread>
#include <utility>

#include "daemon_process.hpp"
#include "emulated_lidar.hpp"

namespace cornerd::system_test {
namespace {

class OdometryControllers : public DaemonTest {
 protected:
  /// One that says this fifty times a second, for as long as it lives.
  std::jthread controller(std::string line) {
    return std::jthread(
        [line = std::move(line), control = connect("control.sock")](std::stop_token stop) mutable {
          while (!stop.stop_requested()) {
            control.send(line + '\n');
            std::this_thread::sleep_for(std::chrono::milliseconds(20));
          }
        });
  }

  /// What the STATUS of a while says last of odometry, or first in that state.
  json odometry_of(TestClient& client, const std::string& state, int most = 40) {
    json status;
    for (int i = 0; i < most; ++i) {
      status = next_of(client, "STATUS");
      if (!status.is_object() || status["odometry"]["state"] == state) break;
    }
    return status;
  }
};

constexpr const char* kBoth = R"({"class":"ODOMETRY","left":7,"right":7,"gyro":0})";

TEST_F(OdometryControllers, LinesWithoutATimeOfAReplay_AreOfTheRecordingsTime) {
  const DaemonProcess daemon = start({"/lidar/speed=1", "/odometry/source=socket"});
  TestClient client = connect();
  const std::jthread robot = controller(kBoth);
  ASSERT_EQ(odometry_of(client, "running")["odometry"]["state"], "running") << daemon.output();
  // On a machine that is slow many lines come between two samples, and are of one time.
  json odometry;
  for (int i = 0; i < 40; ++i) {
    odometry = next_of(client, "STATUS")["odometry"];
    const bool runs = odometry["state"] == "running";
    if (runs && odometry["counters"]["readings"].get<int>() >= 100) break;
  }
  EXPECT_EQ(odometry["state"], "running") << odometry;
  const json counters = odometry["counters"];
  EXPECT_GE(counters["readings"].get<int>(), 100) << odometry;
  EXPECT_LT(counters["past"].get<int>() + counters["future"].get<int>(),
            counters["readings"].get<int>())
      << odometry;
}

TEST_F(OdometryControllers, FirstOneWhoseLinesAreOfNoUse_LosesItsPlaceToAGoodOne) {
  const EmulatedLidar lidar(folder_ / "map.json", folder_ / "lidar");
  const DaemonProcess daemon =
      start({"/lidar/driver=rplidar", "/lidar/device=" + (folder_ / "lidar").string(),
             "/odometry/source=socket"});
  TestClient client = connect();
  for (const char* useless : {R"({"class":"ODOMETRY","left":7})",
                              R"({"class":"ODOMETRY","t":12,"left":7,"right":7,"gyro":0})"}) {
    const std::jthread first = controller(useless);
    // Before the good one comes, so that it is the first one that has the place.
    for (int i = 0; i < 2; ++i) static_cast<void>(next_of(client, "STATUS"));
    const std::jthread second = controller(kBoth);
    const json status = odometry_of(client, "running");
    EXPECT_EQ(status["odometry"]["state"], "running") << useless << status << daemon.output();
  }
}

}  // namespace
}  // namespace cornerd::system_test
