// SPDX-License-Identifier: MIT
// What the daemon's log goes to fails: the robot is told its place all the same.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/stat.h>

#include <filesystem>
#include <string>
#include <vector>

#include "daemon/file_descriptor.hpp"
#include "daemon_process.hpp"

namespace cornerd::system_test {
namespace {

class Streams : public DaemonTest {
 protected:
  /// The lidar's own events may come in between.
  static bool tells_of_the_map(TestClient& client) {
    constexpr int kMostEvents = 20;
    for (int i = 0; i < kMostEvents; ++i) {
      if (next_of(client, "EVENT")["what"] == "map loaded") return true;
    }
    return false;
  }

  /// That it has poses, that a reload, which it logs, is survived, and that it ends well.
  void expect_service(DaemonProcess& daemon) {
    TestClient client = connect();
    next_of(client, "POSE");
    client.send(R"({"class":"WATCH","classes":["POSE","EVENT"]})"
                "\n");
    for (int i = 0; i < 3; ++i) {
      daemon.send_signal(SIGHUP);
      EXPECT_TRUE(tells_of_the_map(client));
    }
    EXPECT_EQ(next_of(client, "POSE")["class"], "POSE");
    daemon.send_signal(SIGTERM);
    EXPECT_EQ(daemon.wait_for_exit(), 0);
  }
};

TEST_F(Streams, Closed_AreNotTakenByAnythingElse) {
  DaemonProcess daemon(with_config(), "");
  connect();
  const std::filesystem::path descriptors = "/proc/" + std::to_string(daemon.pid()) + "/fd";
  for (const char* fd : {"0", "1", "2"}) {
    EXPECT_EQ(std::filesystem::read_symlink(descriptors / fd), "/dev/null");
  }
  expect_service(daemon);
}

TEST_F(Streams, DiskThatIsFull_CostsTheLogAlone) {
  DaemonProcess daemon(with_config(), "/dev/full");
  expect_service(daemon);
}

TEST_F(Streams, ReaderOfTheLogThatLeaves_IsNotFollowed) {
  const std::filesystem::path pipe = folder_ / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  daemon::FileDescriptor reader(::open(pipe.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC));
  DaemonProcess daemon(with_config(), pipe);
  connect();
  reader = {};
  expect_service(daemon);
}

}  // namespace
}  // namespace cornerd::system_test
