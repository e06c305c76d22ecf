// SPDX-License-Identifier: MIT
#include "daemon/systemd.hpp"

#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <cstdlib>
#include <cstring>
#include <string>

#include "tests/temporary_folder.hpp"

namespace cornerd::daemon {
namespace {

/// The service manager's side of the socket.
class NotifierTest : public ::testing::Test {
 protected:
  NotifierTest() : manager_(::socket(AF_UNIX, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0)) {
    const std::string path = (folder_ / "notify").string();
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    std::memcpy(address.sun_path, path.data(), path.size());
    EXPECT_EQ(::bind(manager_.get(), reinterpret_cast<const sockaddr*>(&address), sizeof(address)),
              0);
    ::setenv("NOTIFY_SOCKET", path.c_str(), 1);
  }
  ~NotifierTest() override {
    for (const char* name : {"NOTIFY_SOCKET", "WATCHDOG_USEC", "WATCHDOG_PID"}) ::unsetenv(name);
  }

  std::string received() {
    char text[256];
    const ssize_t count = ::recv(manager_.get(), text, sizeof(text), 0);
    return count < 0 ? "nothing" : std::string(text, static_cast<std::size_t>(count));
  }

 private:
  test::TemporaryFolder folder_;
  FileDescriptor manager_;
};

TEST_F(NotifierTest, States_Sent_InSdNotifyFormat) {
  Notifier notifier;
  notifier.ready();
  EXPECT_EQ(received(), "READY=1");
  notifier.alive();
  EXPECT_EQ(received(), "WATCHDOG=1");
  notifier.stopping();
  EXPECT_EQ(received(), "STOPPING=1");
}

TEST_F(NotifierTest, SameStatus_SentOnce) {
  Notifier notifier;
  notifier.status("lidar absent");
  notifier.status("lidar absent");
  notifier.status("lidar running");
  EXPECT_EQ(received(), "STATUS=lidar absent");
  EXPECT_EQ(received(), "STATUS=lidar running");
  EXPECT_EQ(received(), "nothing");
}

TEST_F(NotifierTest, WatchdogTimeout_PeriodIsHalf) {
  ::setenv("WATCHDOG_USEC", "1000001", 1);
  EXPECT_EQ(Notifier().watchdog_period_us(), 500'000u);
  ::setenv("WATCHDOG_PID", std::to_string(::getpid()).c_str(), 1);
  EXPECT_EQ(Notifier().watchdog_period_us(), 500'000u);
}

TEST_F(NotifierTest, WatchdogOfAnotherProcessOrInvalid_NoPeriod) {
  EXPECT_EQ(Notifier().watchdog_period_us(), std::nullopt);
  ::setenv("WATCHDOG_USEC", "1000000", 1);
  ::setenv("WATCHDOG_PID", "1", 1);
  EXPECT_EQ(Notifier().watchdog_period_us(), std::nullopt);
  ::unsetenv("WATCHDOG_PID");
  for (const char* wrong : {"", "soon", "0", "-5", "1000000 "}) {
    ::setenv("WATCHDOG_USEC", wrong, 1);
    EXPECT_EQ(Notifier().watchdog_period_us(), std::nullopt) << wrong;
  }
}

TEST_F(NotifierTest, WithoutManager_NothingSent) {
  for (const char* address : {"", "relative", "/nowhere/notify"}) {
    ::setenv("NOTIFY_SOCKET", address, 1);
    Notifier notifier;
    notifier.ready();
  }
  EXPECT_EQ(received(), "nothing");
}

}  // namespace
}  // namespace cornerd::daemon
