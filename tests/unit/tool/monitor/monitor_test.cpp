// SPDX-License-Identifier: MIT
// The monitor on a terminal of its own: what it writes, what ends it, what it leaves behind.
#include "tool/monitor/monitor.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <pty.h>
#include <sys/ioctl.h>
#include <sys/wait.h>
#include <unistd.h>
#include <utmp.h>

#include <csignal>
#include <cstring>
#include <optional>
#include <string>

#include "listening_socket.hpp"
#include "monitor/daemon_lines.hpp"
#include "tests/temporary_folder.hpp"

namespace cornerd::tool {
namespace {

/// What a test waits for at most; none takes that long but one that fails.
constexpr int kPatience_ms = 60'000;

/// The monitor in a process of its own, on a pseudo-terminal that the test is the person of.
class MonitorOnTerminal : public testing::Test {
 protected:
  MonitorOnTerminal() : socket_(folder_.path() / "pose.sock") {
    const winsize size{.ws_row = 24, .ws_col = 80, .ws_xpixel = 0, .ws_ypixel = 0};
    EXPECT_EQ(::openpty(&person_, &terminal_, nullptr, nullptr, &size), 0);
    EXPECT_EQ(::tcgetattr(terminal_, &before_), 0);
  }
  ~MonitorOnTerminal() override {
    if (child_ > 0) {
      ::kill(child_, SIGKILL);
      ::waitpid(child_, nullptr, 0);
    }
    ::close(person_);
    ::close(terminal_);
    if (daemon_ >= 0) ::close(daemon_);
  }

  void start() {
    child_ = ::fork();
    if (child_ != 0) return;
    ::login_tty(terminal_);
    try {
      Monitor(socket_, Scene(), ViewChoice(), /*colours=*/false).run();
    } catch (...) {
      ::_exit(1);
    }
    ::_exit(0);
  }

  void send_message(const std::string& line) const {
    const std::string text = line + "\n";
    EXPECT_EQ(::send(daemon_, text.data(), text.size(), MSG_NOSIGNAL),
              static_cast<ssize_t>(text.size()));
  }
  void press(const char* keys) const { EXPECT_GT(::write(person_, keys, std::strlen(keys)), 0); }

  /// Reads the screen until it has `text`; false if it never has.
  bool shows(const std::string& text) {
    pollfd entry{.fd = person_, .events = POLLIN, .revents = 0};
    while (screen_.find(text) == std::string::npos) {
      if (::poll(&entry, 1, kPatience_ms) <= 0) return false;
      char bytes[4096];
      const ssize_t got = ::read(person_, bytes, sizeof bytes);
      if (got <= 0) return false;
      screen_.append(bytes, static_cast<std::size_t>(got));
    }
    screen_.erase(0, screen_.find(text) + text.size());
    return true;
  }

  /// It has ended with 0 and the terminal is as it was.
  void expect_clean_end() {
    EXPECT_TRUE(shows("\x1b[?25h\x1b[?1049l"));
    int status = -1;
    EXPECT_EQ(::waitpid(child_, &status, 0), child_);
    child_ = -1;
    EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << status;
    termios after{};
    EXPECT_EQ(::tcgetattr(terminal_, &after), 0);
    EXPECT_EQ(after.c_lflag, before_.c_lflag);
    EXPECT_EQ(after.c_iflag, before_.c_iflag);
    EXPECT_EQ(after.c_oflag, before_.c_oflag);
  }

  /// Started, connected, and a first frame with a fix on the screen.
  void start_with_daemon() {
    listener_.emplace(socket_);
    start();
    ASSERT_TRUE(shows("\x1b[?1049h"));
    daemon_ = listener_->accept();
    send_message(kVersionLine);
    send_message(status_line());
    send_message(kFixLine);
    ASSERT_TRUE(shows("fix  hall"));
  }

  test::TemporaryFolder folder_;
  std::filesystem::path socket_;
  std::optional<ListeningSocket> listener_;
  int daemon_ = -1;
  int person_ = -1;
  int terminal_ = -1;
  termios before_{};
  pid_t child_ = -1;
  std::string screen_;
};

TEST_F(MonitorOnTerminal, KeyQ_EndsAndRestoresTerminal) {
  start_with_daemon();
  termios during{};
  EXPECT_EQ(::tcgetattr(terminal_, &during), 0);
  EXPECT_EQ(during.c_lflag & (ICANON | ECHO), 0U);
  press("q");
  expect_clean_end();
}

TEST_F(MonitorOnTerminal, CtrlC_Ends) {
  start_with_daemon();
  press("\x03");
  expect_clean_end();
}

TEST_F(MonitorOnTerminal, TerminationSignal_Ends) {
  start_with_daemon();
  ::kill(child_, SIGTERM);
  expect_clean_end();
}

TEST_F(MonitorOnTerminal, LostDaemon_IsShownAndReconnected) {
  start_with_daemon();
  ::close(daemon_);
  ASSERT_TRUE(shows("no daemon since"));
  daemon_ = listener_->accept();
  send_message(status_line());
  send_message(kFixLine);
  EXPECT_TRUE(shows("fix  hall"));
  press("q");
  expect_clean_end();
}

TEST_F(MonitorOnTerminal, AbsentDaemon_IsWaitedFor) {
  start();
  ASSERT_TRUE(shows("No such file or directory"));
  listener_.emplace(socket_);
  daemon_ = listener_->accept();
  send_message(status_line());
  send_message(kFixLine);
  EXPECT_TRUE(shows("fix  hall"));
  press("q");
  expect_clean_end();
}

TEST_F(MonitorOnTerminal, NewSize_IsDrawnCompletely) {
  start_with_daemon();
  const winsize size{.ws_row = 40, .ws_col = 100, .ws_xpixel = 0, .ws_ypixel = 0};
  ASSERT_EQ(::ioctl(person_, TIOCSWINSZ, &size), 0);
  EXPECT_TRUE(shows("\x1b[2J"));
  EXPECT_TRUE(shows("\x1b[40;1H"));
  press("q");
  expect_clean_end();
}

TEST_F(MonitorOnTerminal, Stop_RestoresTerminalUntilContinued) {
  start_with_daemon();
  ::kill(child_, SIGTSTP);
  ASSERT_TRUE(shows("\x1b[?1049l"));
  int status = 0;
  ASSERT_EQ(::waitpid(child_, &status, WUNTRACED), child_);
  ASSERT_TRUE(WIFSTOPPED(status));
  termios during{};
  EXPECT_EQ(::tcgetattr(terminal_, &during), 0);
  EXPECT_EQ(during.c_lflag, before_.c_lflag);
  ::kill(child_, SIGCONT);
  EXPECT_TRUE(shows("\x1b[?1049h"));
  EXPECT_TRUE(shows("fix  hall"));
  press("q");
  expect_clean_end();
}

TEST_F(MonitorOnTerminal, StalledTerminal_StillEnds) {
  start_with_daemon();
  // Ctrl-S: from here on nothing is written any more.
  press("\x13");
  for (int i = 0; i < 200; ++i) {
    send_message(i % 2 == 0 ? kLostLine : kFixLine);
  }
  ::kill(child_, SIGTERM);
  int status = -1;
  EXPECT_EQ(::waitpid(child_, &status, 0), child_);
  child_ = -1;
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << status;
  termios after{};
  EXPECT_EQ(::tcgetattr(terminal_, &after), 0);
  EXPECT_EQ(after.c_lflag, before_.c_lflag);
}

}  // namespace
}  // namespace cornerd::tool
