// SPDX-License-Identifier: MIT

#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <stdlib.h>

#include <string>

#include "daemon/require_fd.hpp"
#include "daemon_process.hpp"
#include "tests/wait_until.hpp"

namespace cornerd::system_test {
namespace {

class LidarState : public DaemonTest {
 protected:
  /// The first STATUS with this lidar state and a reason: without one, the port was not tried yet.
  static json status_in(TestClient& client, const std::string& state) {
    return next_of(client, "STATUS", [&](const json& status) {
      const json& lidar = status["lidar"];
      return lidar["state"] == state && lidar.contains("detail");
    });
  }
};

TEST_F(LidarState, MissingPort_ReportedAndWaitedFor) {
  const DaemonProcess daemon = start({"/lidar/driver=rplidar", "/lidar/device=/dev/no_such_lidar"});
  TestClient client = connect();
  const json status = status_in(client, "absent");
  EXPECT_NE(status["lidar"]["detail"].get<std::string>().find("/dev/no_such_lidar"),
            std::string::npos)
      << status;
  EXPECT_TRUE(daemon.is_running());
  EXPECT_TRUE(test::wait_until([&] {
    return daemon.output().find("/dev/no_such_lidar") != std::string::npos;
  })) << daemon.output();
}

TEST_F(LidarState, MissingRecording_Reported) {
  const DaemonProcess daemon = start({"/lidar/file=/nowhere/r.bin"});
  TestClient client = connect();
  const json status = status_in(client, "faulty");
  EXPECT_NE(status["lidar"]["detail"].get<std::string>().find("/nowhere/r.bin"), std::string::npos);
  EXPECT_TRUE(daemon.is_running());
}

TEST_F(LidarState, EndOfRecording_ReportedAndPollAnswersLastPose) {
  const DaemonProcess daemon = start({"/lidar/loop=false", "/lidar/speed=max"});
  TestClient client = connect();
  const json status = status_in(client, "ended");
  EXPECT_EQ(status["class"], "STATUS");
  client.send(R"({"class":"POLL","id":"end"})"
              "\n");
  const json pose = next_of(client, "POSE");
  EXPECT_EQ(pose["class"], "POSE");
  EXPECT_TRUE(daemon.is_running());
}

/// A device that never answers.
TEST_F(LidarState, TerminationInAnyState_EndsAtOnce) {
  const daemon::FileDescriptor master(::posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC));
  ASSERT_EQ(::grantpt(master.get()) | ::unlockpt(master.get()), 0);
  const std::string silent = ::ptsname(master.get());
  const struct {
    std::string device;
    std::string state;
  } cases[] = {{"/dev/no_such_lidar", "absent"}, {silent, "identifying"}, {silent, "backoff"}};
  for (const auto& [device, state] : cases) {
    DaemonProcess daemon = start({"/lidar/driver=rplidar", "/lidar/device=" + device});
    TestClient client = connect();
    EXPECT_TRUE(status_in(client, state).is_object()) << device;
    daemon.send_signal(SIGTERM);
    EXPECT_EQ(daemon.wait_for_exit(), 0) << device << ", " << state;
  }
}

}  // namespace
}  // namespace cornerd::system_test
