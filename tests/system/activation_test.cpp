// SPDX-License-Identifier: MIT
// Socket activation and access to the control socket.
#include <grp.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstring>
#include <string>

#include "daemon/unix_listener.hpp"
#include "daemon_process.hpp"

namespace cornerd::system_test {
namespace {

class Activation : public DaemonTest {};

TEST_F(Activation, SocketsOfServiceManager_ServedAndNotRemoved) {
  const daemon::UnixListener pose(folder_ / "pose.sock", 0666);
  const daemon::UnixListener control(folder_ / "control.sock", 0660);
  // Clients may connect before the daemon starts.
  TestClient early(folder_ / "pose.sock");
  ASSERT_TRUE(early.is_connected());
  DaemonProcess daemon(with_config(), folder_ / "log", {}, {pose.fd(), control.fd()});
  EXPECT_EQ(next_of(early, "POSE")["class"], "POSE");
  TestClient controller = connect("control.sock");
  controller.send(R"({"class":"RELOCALIZE","id":1})"
                  "\n");
  EXPECT_EQ(next_of(controller, "OK")["id"], 1);
  daemon.send_signal(SIGTERM);
  EXPECT_EQ(daemon.wait_for_exit(), 0) << daemon.output();
  EXPECT_TRUE(std::filesystem::exists(folder_ / "pose.sock"));
  EXPECT_TRUE(std::filesystem::exists(folder_ / "control.sock"));
}

TEST_F(Activation, SocketOfAnotherPath_NotServed) {
  const daemon::UnixListener other(folder_ / "other.sock", 0666);
  const DaemonProcess daemon(with_config(), folder_ / "log", {}, {other.fd()});
  TestClient client = connect("control.sock");
  next(client);
  EXPECT_NE(daemon.output().find("other.sock"), std::string::npos) << daemon.output();
}

/// Connects as user nobody without groups. True if the first line is VERSION.
bool others_are_served(const std::filesystem::path& socket) {
  const pid_t child = ::fork();
  if (child == 0) {
    constexpr uid_t kNobody = 65534;
    if (::setgroups(0, nullptr) != 0 || ::setgid(kNobody) != 0 || ::setuid(kNobody) != 0) {
      ::_exit(2);
    }
    TestClient client(socket);
    const auto line = client.read_line(60'000);
    ::_exit(line && line->find("\"VERSION\"") != std::string::npos ? 0 : 1);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

TEST_F(Activation, UserOutsideGroup_RefusedByControlSocketOnly) {
  if (::geteuid() != 0) GTEST_SKIP() << "changing the user needs root";
  const DaemonProcess daemon = start();
  connect("control.sock");
  // A mode that would let everybody connect.
  std::filesystem::permissions(folder_ / "control.sock", std::filesystem::perms::all);
  std::filesystem::permissions(folder_ / "", std::filesystem::perms::all);
  EXPECT_TRUE(others_are_served(folder_ / "pose.sock"));
  EXPECT_FALSE(others_are_served(folder_ / "control.sock"));
}

}  // namespace
}  // namespace cornerd::system_test
