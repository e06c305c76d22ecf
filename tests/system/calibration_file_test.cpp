// SPDX-License-Identifier: MIT
// The estimated bias of the lidar survives a restart, for the same lidar only.
#include <gtest/gtest.h>
#include <signal.h>

#include <filesystem>
#include <fstream>
#include <memory>
#include <string>

#include "daemon_process.hpp"
#include "emulated_lidar.hpp"

namespace cornerd::system_test {
namespace {

class CalibrationFile : public DaemonTest {
 protected:
  DaemonProcess start_on_lidar() {
    return start({"/lidar/driver=rplidar", "/lidar/device=" + (folder_ / "lidar").string(),
                  "/advanced/lidar/calibration_file=" + file_.string()});
  }

  /// The first STATUS whose bias has at least this many scans.
  json status_after(std::uint64_t scans) {
    TestClient client = connect();
    return next_of(client, "STATUS", [&](const json& status) {
      const json& lidar = status["lidar"];
      return lidar.contains("bias") && lidar["bias"]["scans"] >= scans;
    });
  }

  void end(DaemonProcess& daemon) {
    daemon.send_signal(SIGTERM);
    ASSERT_EQ(daemon.wait_for_exit(), 0) << daemon.output();
  }

  std::filesystem::path file_ = folder_ / "learned.json";
};

TEST_F(CalibrationFile, Restart_BiasLoadedForSameLidarOnly) {
  {
    const EmulatedLidar lidar(folder_ / "map.json", folder_ / "lidar");
    DaemonProcess daemon = start_on_lidar();
    const json status = status_after(20);
    ASSERT_TRUE(status.is_object()) << daemon.output();
    EXPECT_TRUE(status["lidar"]["bias"]["sigma"].contains("range_offset")) << status;
    EXPECT_FALSE(status["lidar"].value("serial", "").empty()) << status;
    // At most one tick after the STATUS.
    status_after(22);
    end(daemon);
    EXPECT_TRUE(std::filesystem::exists(file_)) << daemon.output();

    DaemonProcess again = start_on_lidar();
    const json known = status_after(1);
    ASSERT_TRUE(known.is_object());
    EXPECT_GE(known["lidar"]["bias"]["scans"], 20u) << known;
    end(again);
  }
  replay::EmulatorConfig another;
  another.serial[0] ^= 0xFF;
  const EmulatedLidar lidar(folder_ / "map.json", folder_ / "lidar", another);
  DaemonProcess daemon = start_on_lidar();
  TestClient client = connect();
  client.send(R"({"class":"WATCH","classes":["EVENT"]})"
              "\n");
  EXPECT_TRUE(next_event(client, "another lidar").is_object()) << daemon.output();
  const json fresh = status_after(1);
  ASSERT_TRUE(fresh.is_object());
  EXPECT_LT(fresh["lidar"]["bias"]["scans"], 20u) << fresh;
  end(daemon);
  EXPECT_NE(daemon.output().find("another lidar"), std::string::npos) << daemon.output();
}

TEST_F(CalibrationFile, ReloadBeforeFirstScan_StoredBiasKept) {
  std::ofstream(file_) << R"({"format": "cornerd-lidar", "scans": 400,
      "bias": {"range_scale": 0.004, "range_offset": 0.001, "bearing_sine": 0, "bearing_cosine": 0},
      "sigma": {"range_scale": 5e-4, "range_offset": 5e-4, "bearing_sine": 3e-4,
                "bearing_cosine": 3e-4}})";
  DaemonProcess daemon = start_on_lidar();
  TestClient client = connect();
  client.send(R"({"class":"WATCH","classes":["EVENT"]})"
              "\n");
  daemon.send_signal(SIGHUP);
  ASSERT_TRUE(next_event(client, "map loaded").is_object()) << daemon.output();
  const EmulatedLidar lidar(folder_ / "map.json", folder_ / "lidar");
  const json status = status_after(1);
  ASSERT_TRUE(status.is_object()) << daemon.output();
  EXPECT_GE(status["lidar"]["bias"]["scans"], 400u) << status;
  end(daemon);
}

TEST_F(CalibrationFile, ReloadAfterChangeOfLidar_OldBiasNotRestored) {
  auto lidar = std::make_unique<EmulatedLidar>(folder_ / "map.json", folder_ / "lidar");
  DaemonProcess daemon = start_on_lidar();
  const json first = status_after(40);
  ASSERT_TRUE(first.is_object()) << daemon.output();
  TestClient client = connect();
  client.send(R"({"class":"WATCH","classes":["EVENT"]})"
              "\n");
  lidar.reset();
  replay::EmulatorConfig another;
  another.serial[0] ^= 0xFF;
  lidar = std::make_unique<EmulatedLidar>(folder_ / "map.json", folder_ / "lidar", another);
  ASSERT_TRUE(next_event(client, "another lidar").is_object()) << daemon.output();
  daemon.send_signal(SIGHUP);
  ASSERT_TRUE(next_event(client, "map loaded").is_object()) << daemon.output();
  TestClient later = connect();
  const json status = next_of(later, "STATUS", [](const json& message) {
    const json& bias = message["lidar"].value("bias", json());
    return bias.is_object() && bias["scans"] < 40u;
  });
  ASSERT_TRUE(status.is_object()) << daemon.output();
  EXPECT_NE(status["lidar"]["serial"], first["lidar"]["serial"]);
  end(daemon);
}

}  // namespace
}  // namespace cornerd::system_test
