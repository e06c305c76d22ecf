// SPDX-License-Identifier: MIT
// What a daemon learns of its lidar is there when it starts again, for the same lidar alone.
#include <gtest/gtest.h>
#include <signal.h>

#include <filesystem>
#include <string>

#include "daemon_process.hpp"
#include "emulated_lidar.hpp"

namespace cornerd::system_test {
namespace {

class LearnedBias : public DaemonTest {
 protected:
  DaemonProcess start_on_lidar() {
    return start({"/lidar/driver=rplidar", "/lidar/device=" + (folder_ / "lidar").string(),
                  "/lidar/learned_file=" + file_.string()});
  }

  /// The first STATUS that tells of at least so many turns that taught.
  json status_after(std::uint64_t turns) {
    TestClient client = connect();
    while (true) {
      json status = next_of(client, "STATUS");
      if (!status.is_object()) return {};
      const json& lidar = status["lidar"];
      if (lidar.contains("bias") && lidar["bias"]["turns"] >= turns) return status;
    }
  }

  void end(DaemonProcess& daemon) {
    daemon.send_signal(SIGTERM);
    ASSERT_EQ(daemon.wait_for_exit(), 0) << daemon.output();
  }

  std::filesystem::path file_ = folder_ / "learned.json";
};

TEST_F(LearnedBias, SameLidar_IsKnownAtTheNextStartAndAnotherIsNot) {
  {
    const EmulatedLidar lidar(folder_ / "map.json", folder_ / "lidar");
    DaemonProcess daemon = start_on_lidar();
    const json status = status_after(20);
    ASSERT_TRUE(status.is_object()) << daemon.output();
    EXPECT_TRUE(status["lidar"]["bias"]["sigma"].contains("range_offset")) << status;
    EXPECT_FALSE(status["lidar"].value("serial", "").empty()) << status;
    // A tick after the STATUS at the latest.
    status_after(22);
    end(daemon);
    EXPECT_TRUE(std::filesystem::exists(file_)) << daemon.output();

    DaemonProcess again = start_on_lidar();
    const json known = status_after(1);
    ASSERT_TRUE(known.is_object());
    EXPECT_GE(known["lidar"]["bias"]["turns"], 20u) << known;
    end(again);
  }
  replay::EmulatorConfig another;
  another.serial[0] ^= 0xFF;
  const EmulatedLidar lidar(folder_ / "map.json", folder_ / "lidar", another);
  DaemonProcess daemon = start_on_lidar();
  TestClient client = connect();
  client.send(R"({"class":"WATCH","classes":["EVENT"]})"
              "\n");
  json event = next_of(client, "EVENT");
  while (event.is_object() && event["what"] != "another lidar") event = next_of(client, "EVENT");
  EXPECT_TRUE(event.is_object()) << daemon.output();
  const json fresh = status_after(1);
  ASSERT_TRUE(fresh.is_object());
  end(daemon);
  EXPECT_NE(daemon.output().find("another lidar"), std::string::npos) << daemon.output();
}

}  // namespace
}  // namespace cornerd::system_test
