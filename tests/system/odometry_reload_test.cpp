// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>
#include <signal.h>

#include <chrono>
#include <fstream>
#include <optional>
#include <string>
#include <thread>

#include "daemon_process.hpp"
#include "emulated_lidar.hpp"

namespace cornerd::system_test {
namespace {

class OdometryReload : public DaemonTest {
 protected:
  void set_publish(bool publish) {
    json settings = json::parse(std::ifstream(config()));
    settings["advanced"]["odometry"]["publish_predictions"] = publish;
    std::ofstream(config()) << settings;
  }

  static json next_in(TestClient& client, const std::string& state) {
    return next_of(client, "POSE", [&](const json& pose) { return pose["state"] == state; });
  }
};

TEST_F(OdometryReload, PublishPredictionsEnabled_WorksWithoutLidar) {
  std::optional<EmulatedLidar> lidar;
  lidar.emplace(folder_ / "map.json", folder_ / "lidar");
  set_publish(false);
  const DaemonProcess daemon =
      start({"/lidar/driver=rplidar", "/lidar/device=" + (folder_ / "lidar").string(),
             "/odometry/source=socket"});
  TestClient client = connect();
  client.send(R"({"class":"WATCH","classes":["POSE"]})"
              "\n");
  const std::jthread controller([control = connect("control.sock")](std::stop_token stop) mutable {
    while (!stop.stop_requested()) {
      control.send("{\"class\":\"ODOMETRY\",\"left\":7,\"right\":7,\"gyro\":0}\n");
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
  });
  ASSERT_TRUE(next_in(client, "fix").is_object()) << daemon.output();
  set_publish(true);
  daemon.send_signal(SIGHUP);
  // Predictions of the new config continue where the scans end.
  ASSERT_TRUE(next_in(client, "predicted").is_object()) << daemon.output();
  lidar.reset();
  json last;
  for (int i = 0; i < 50; ++i) {
    last = next_of(client, "POSE");
    ASSERT_TRUE(last.is_object()) << daemon.output();
  }
  EXPECT_EQ(last["state"], "predicted");
}

}  // namespace
}  // namespace cornerd::system_test
