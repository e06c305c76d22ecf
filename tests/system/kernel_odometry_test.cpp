// SPDX-License-Identifier: MIT

#include <gtest/gtest.h>

#include "daemon_process.hpp"
#include "tests/unit/drivers/odometry/sysfs_tree.hpp"

namespace cornerd::system_test {
namespace {

class KernelOdometry : public DaemonTest {
 protected:
  DaemonProcess start_with_tree() {
    return start({"/lidar/driver=rplidar", "/lidar/device=/dev/no_such_lidar",
                  "/odometry/source=kernel",
                  "/advanced/odometry/kernel/sysfs=" + tree_.root().string()});
  }
  /// The sensors of the first STATUS in which this sensor has this state.
  static json sensors_with(TestClient& client, const char* sensor, const std::string& state) {
    const json::json_pointer sensors("/odometry/sensors");
    const json status = next_of(client, "STATUS", [&](const json& message) {
      return message.value(sensors / sensor / "state", "") == state;
    });
    return status.is_object() ? status[sensors] : status;
  }

  test::SysfsTree tree_;
};

TEST_F(KernelOdometry, BoardSensors_ReadAndStatesPublished) {
  tree_.add_counter(0, "48304180.counter");
  tree_.add_gyro(0, "mpu6050");
  const DaemonProcess daemon = start_with_tree();
  TestClient client = connect();
  const json sensors = sensors_with(client, "right", "running");
  EXPECT_EQ(sensors["left"]["state"], "absent") << sensors;
  EXPECT_NE(sensors["left"]["detail"].get<std::string>().find("48304180.counter"),
            std::string::npos)
      << sensors;
  EXPECT_EQ(sensors["gyro"]["state"], "running");
  EXPECT_NE(daemon.output().find("odometry left absent"), std::string::npos) << daemon.output();

  tree_.add_counter(1, "48300180.counter");
  EXPECT_EQ(sensors_with(client, "left", "running")["right"]["state"], "running");
  tree_.set_of_count(0, "enable", "0");
  EXPECT_TRUE(sensors_with(client, "right", "disabled").is_object());
  EXPECT_TRUE(daemon.is_running());
}

TEST_F(KernelOdometry, OdometryOfClient_Refused) {
  const DaemonProcess daemon = start_with_tree();
  TestClient client = connect("control.sock");
  client.send(R"({"class":"ODOMETRY","left":1,"right":2})"
              "\n");
  EXPECT_EQ(next_of(client, "ERROR")["code"], "unsupported");
}

}  // namespace
}  // namespace cornerd::system_test
