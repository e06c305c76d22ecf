// SPDX-License-Identifier: MIT
#include "tool/monitor/terminal.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>

#include "tool/command_line/failure.hpp"

namespace cornerd::tool {

namespace {

// xterm's "control sequences": alternate screen, cursor off and on.
constexpr std::string_view kTakeScreen = "\x1b[?1049h\x1b[?25l\x1b[2J";
constexpr std::string_view kGiveBackScreen = "\x1b[0m\x1b[?25h\x1b[?1049l";
/// Wait for a slow terminal to accept the last output.
constexpr int kLastWords_ms = 200;
/// Larger answers are wrong.
constexpr std::size_t kMaxColumns = 1000;
constexpr std::size_t kMaxRows = 500;

/// Opens standard output's terminal again: O_NONBLOCK on the shared open file would affect the
/// shell.
int open_own_terminal() {
  constexpr int kFlags = O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC;
  const int fd = ::open("/proc/self/fd/1", kFlags);
  // After su the terminal may belong to another user; /dev/tty is open to everybody.
  return fd >= 0 ? fd : ::open("/dev/tty", kFlags);
}

}  // namespace

Terminal::Terminal() {
  if (::isatty(STDOUT_FILENO) == 0) {
    throw Failure(
        "monitor: standard output is no terminal; cornerctl watch writes to files and pipes");
  }
  fd_ = open_own_terminal();
  if (fd_ < 0 || ::tcgetattr(fd_, &before_) != 0) {
    if (fd_ >= 0) ::close(fd_);
    throw Failure("monitor: the terminal cannot be opened");
  }
  enter();
}

Terminal::~Terminal() {
  leave();
  ::close(fd_);
}

void Terminal::enter() {
  termios raw = before_;
  // Ctrl-C and Ctrl-Z stay signals; SignalQueue reads them.
  raw.c_lflag &= ~static_cast<tcflag_t>(ICANON | ECHO);
  raw.c_cc[VMIN] = 0;
  raw.c_cc[VTIME] = 0;
  ::tcsetattr(fd_, TCSANOW, &raw);
  show(kTakeScreen);
}

void Terminal::leave() {
  // Completes the pending frame first, which may end inside a control sequence.
  unsent_ += kGiveBackScreen;
  pollfd entry{.fd = fd_, .events = POLLOUT, .revents = 0};
  while (flush() && has_unsent() && ::poll(&entry, 1, kLastWords_ms) > 0) {
  }
  unsent_.clear();
  ::tcflush(fd_, TCIFLUSH);
  ::tcsetattr(fd_, TCSANOW, &before_);
}

Terminal::Size Terminal::size() const {
  winsize window{};
  if (::ioctl(fd_, TIOCGWINSZ, &window) != 0 || window.ws_col == 0 || window.ws_row == 0) return {};
  return {std::min<std::size_t>(window.ws_col, kMaxColumns),
          std::min<std::size_t>(window.ws_row, kMaxRows)};
}

std::optional<std::string> Terminal::take_keys() {
  char bytes[256];
  const ssize_t got = ::read(fd_, bytes, sizeof bytes);
  if (got < 0 && errno != EAGAIN && errno != EINTR) return std::nullopt;
  return got > 0 ? plain_keys({bytes, static_cast<std::size_t>(got)}) : std::string();
}

bool Terminal::show(std::string_view bytes) {
  unsent_ += bytes;
  return flush();
}

bool Terminal::flush() {
  while (!unsent_.empty()) {
    const ssize_t sent = ::write(fd_, unsent_.data(), unsent_.size());
    if (sent < 0 && errno == EINTR) continue;
    if (sent < 0) return errno == EAGAIN;
    unsent_.erase(0, static_cast<std::size_t>(sent));
  }
  return true;
}

std::string plain_keys(std::string_view bytes) {
  std::string keys;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    const bool begins_sequence =
        bytes[i] == '\x1b' && i + 1 < bytes.size() && (bytes[i + 1] == '[' || bytes[i + 1] == 'O');
    if (!begins_sequence) {
      keys += bytes[i];
      continue;
    }
    // ECMA-48, 5.4: parameters until a byte from @ to ~.
    i += 2;
    while (i < bytes.size() && (bytes[i] < '@' || bytes[i] > '~')) ++i;
  }
  return keys;
}

}  // namespace cornerd::tool
