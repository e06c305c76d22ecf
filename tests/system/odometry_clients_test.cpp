// SPDX-License-Identifier: MIT
// Clients that send ODOMETRY to the built daemon.
#include <gtest/gtest.h>

#include <chrono>
#include <string>
#include <thread>
#include <utility>

#include "daemon_process.hpp"
#include "emulated_lidar.hpp"

namespace cornerd::system_test {
namespace {

class OdometryClients : public DaemonTest {
 protected:
  /// A client that sends this line at 50 Hz during its lifetime.
  std::jthread controller(std::string line) {
    return std::jthread(
        [line = std::move(line), control = connect("control.sock")](std::stop_token stop) mutable {
          while (!stop.stop_requested()) {
            control.send(line + '\n');
            std::this_thread::sleep_for(std::chrono::milliseconds(20));
          }
        });
  }

  /// The last odometry state in STATUS within some time, or the first equal to that state.
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

TEST_F(OdometryClients, Replay_LinesWithoutTime_GetRecordingTime) {
  const DaemonProcess daemon = start({"/lidar/speed=1", "/odometry/source=socket"});
  TestClient client = connect();
  const std::jthread robot = controller(kBoth);
  ASSERT_EQ(odometry_of(client, "running")["odometry"]["state"], "running") << daemon.output();
  // On a slow machine many lines arrive between two samples and get the same time.
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

TEST_F(OdometryClients, FirstClientUnusable_ReplacedBySecond) {
  const EmulatedLidar lidar(folder_ / "map.json", folder_ / "lidar");
  const DaemonProcess daemon =
      start({"/lidar/driver=rplidar", "/lidar/device=" + (folder_ / "lidar").string(),
             "/odometry/source=socket"});
  TestClient client = connect();
  for (const char* useless : {R"({"class":"ODOMETRY","left":7})",
                              R"({"class":"ODOMETRY","t":12,"left":7,"right":7,"gyro":0})"}) {
    const std::jthread first = controller(useless);
    // The unusable client connects first, so that it is selected first.
    for (int i = 0; i < 2; ++i) static_cast<void>(next_of(client, "STATUS"));
    const std::jthread second = controller(kBoth);
    const json status = odometry_of(client, "running");
    EXPECT_EQ(status["odometry"]["state"], "running") << useless << status << daemon.output();
  }
}

}  // namespace
}  // namespace cornerd::system_test
