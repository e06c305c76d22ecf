// SPDX-License-Identifier: MIT
#include "tool/doctor/daemon_probe.hpp"

#include <gtest/gtest.h>

#include <cerrno>
#include <string>
#include <thread>

#include "listening_socket.hpp"
#include "tests/temporary_folder.hpp"

namespace cornerd::tool {
namespace {

using namespace std::chrono_literals;

constexpr const char* kGreeting =
    "{\"class\":\"VERSION\",\"program\":\"cornerd\",\"version\":\"1.2.3\",\"schema\":2}\n"
    "{\"class\":\"STATUS\",\"t\":1,\"lidar\":{\"state\":\"running\"}}\nnonsense\n";

TEST(ProbeDaemon, Messages_AreCounted) {
  const test::TemporaryFolder folder;
  const ListeningSocket daemon(folder.path() / "pose.sock");
  std::string messages = kGreeting;
  messages +=
      "{\"class\":\"POSE\",\"t\":1,\"state\":\"fix\",\"rmse\":0.004}\n"
      "{\"class\":\"SCAN\",\"t\":1,\"angles\":[0,1,2],\"ranges\":[2,0,3]}\n";
  for (int i = 0; i < 10; ++i) messages += "{\"class\":\"POSE\",\"t\":1,\"state\":\"lost\"}\n";
  // The queue of the socket holds both until they are wanted.
  const std::jthread client([&] { daemon.accept_and_send(messages); });
  const DaemonView view = probe_daemon(folder.path() / "pose.sock", 60s);
  EXPECT_EQ(view.connect_errno, 0);
  EXPECT_EQ(view.rmse_m, std::vector<double>{0.004});
  EXPECT_EQ(view.scan_returns_m, (std::vector<float>{2, 3}));
  EXPECT_EQ(view.version, "1.2.3");
  ASSERT_TRUE(view.status);
  EXPECT_EQ(view.status->lidar_state, "running");
  EXPECT_FALSE(view.odometry_hz);
  EXPECT_EQ(view.poses[static_cast<std::size_t>(core::PoseState::kLost)], 10U);
}

TEST(ProbeDaemon, OdometryReadings_GiveRate) {
  const test::TemporaryFolder folder;
  const ListeningSocket daemon(folder.path() / "pose.sock");
  std::string messages = kGreeting;
  for (int i = 0; i < 10; ++i) messages += "{\"class\":\"POSE\",\"t\":1,\"state\":\"lost\"}\n";
  const auto status = [](const char* t_s, const char* readings) {
    return std::string("{\"class\":\"STATUS\",\"t\":") + t_s +
           ",\"lidar\":{\"state\":\"running\"},\"odometry\":{\"state\":\"running\",\"counters\":"
           "{\"readings\":" +
           readings + "}}}\n";
  };
  messages += status("7", "100") + status("7.1", "101") + status("9", "150");
  const std::jthread client([&] { daemon.accept_and_send(messages); });
  const DaemonView view = probe_daemon(folder.path() / "pose.sock", 60s);
  ASSERT_TRUE(view.odometry_hz);
  EXPECT_DOUBLE_EQ(*view.odometry_hz, 25);
}

TEST(ProbeDaemon, SilentDaemon_TimesOut) {
  const test::TemporaryFolder folder;
  const ListeningSocket daemon(folder.path() / "pose.sock");
  const DaemonView view = probe_daemon(folder.path() / "pose.sock", 1ms);
  EXPECT_EQ(view.connect_errno, 0);
  EXPECT_EQ(view.version, "");
}

TEST(ProbeDaemon, NoDaemon_GivesErrno) {
  EXPECT_EQ(probe_daemon("/nowhere/pose.sock", 1s).connect_errno, ENOENT);
  EXPECT_EQ(probe_daemon(std::string(200, 'x'), 1s).connect_errno, ENAMETOOLONG);
}

}  // namespace
}  // namespace cornerd::tool
