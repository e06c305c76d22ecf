// SPDX-License-Identifier: MIT
#include "replay/emulator/pseudo_terminal.hpp"

#include <fcntl.h>
#include <poll.h>
#include <stdlib.h>
#include <sys/ioctl.h>
#include <termios.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <string>
#include <system_error>
#include <thread>

#include "drivers/serial/baud_rate.hpp"

namespace cornerd::replay {
namespace {

[[noreturn]] void fail(const std::string& what) {
  throw std::system_error(errno, std::generic_category(), what);
}

void make_link(const std::filesystem::path& link, const std::filesystem::path& target) {
  if (std::filesystem::is_symlink(std::filesystem::symlink_status(link))) {
    std::filesystem::remove(link);
  } else if (std::filesystem::exists(link)) {
    throw std::system_error(EEXIST, std::generic_category(),
                            link.string() + ": is no symbolic link, name another path");
  }
  std::error_code error;
  std::filesystem::create_symlink(target, link, error);
  if (error) throw std::system_error(error, link.string() + ": cannot be made, name another path");
}

}  // namespace

PseudoTerminal::PseudoTerminal(const std::filesystem::path& link, std::uint32_t baud)
    : link_(link), baud_(baud) {
  master_ = ::posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC | O_NONBLOCK);
  if (master_ < 0) fail("pseudo-terminal");
  try {
    std::array<char, 128> name{};
    if (::grantpt(master_) != 0 || ::unlockpt(master_) != 0 ||
        ::ptsname_r(master_, name.data(), name.size()) != 0) {
      fail("pseudo-terminal");
    }
    path_ = name.data();
    if (!prepare_for_next_client()) fail(path_.string());
    if (!link_.empty()) make_link(link_, path_);
  } catch (...) {
    ::close(master_);
    throw;
  }
}

PseudoTerminal::~PseudoTerminal() {
  std::error_code ignored;
  if (!link_.empty() && std::filesystem::read_symlink(link_, ignored) == path_) {
    std::filesystem::remove(link_, ignored);
  }
  ::close(master_);
}

/// Raw, without bytes that an earlier client left unread. The next client may be there already, so
/// its settings and output are kept.
bool PseudoTerminal::prepare_for_next_client() {
  const int client_end = ::open(path_.c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC | O_NONBLOCK);
  if (client_end < 0) return false;
  termios settings{};
  if (::tcgetattr(client_end, &settings) == 0 && (settings.c_lflag & (ICANON | ECHO)) != 0) {
    ::cfmakeraw(&settings);
    ::tcsetattr(client_end, TCSANOW, &settings);
    drivers::set_baud_rate(client_end, baud_);
  }
  ::tcflush(client_end, TCIFLUSH);
  // A pseudo-terminal stays exclusive when its client is killed. (Without CAP_SYS_ADMIN open() has
  // failed above, and no next client is possible.)
  ::ioctl(client_end, TIOCNXCL);
  ::close(client_end);
  has_client_ = false;
  return true;
}

bool PseudoTerminal::wait(int timeout_ms) {
  pollfd poll_for{master_, POLLIN, 0};
  if (::poll(&poll_for, 1, timeout_ms) < 0) return has_client_;
  if ((poll_for.revents & POLLHUP) == 0) {
    has_client_ = true;
  } else if ((poll_for.revents & POLLIN) == 0) {
    if (has_client_) prepare_for_next_client();
    // poll() returns at once while the hang-up lasts.
    std::this_thread::sleep_for(std::chrono::milliseconds(timeout_ms));
  }
  return has_client_;
}

bool PseudoTerminal::has_speed(std::uint32_t baud) const {
  const std::uint32_t set = drivers::baud_rate(master_);
  return set == 0 || set == baud;
}

std::size_t PseudoTerminal::read(std::span<std::uint8_t> buffer) {
  const ssize_t count = ::read(master_, buffer.data(), buffer.size());
  return count > 0 ? static_cast<std::size_t>(count) : 0;
}

std::size_t PseudoTerminal::write(std::span<const std::uint8_t> bytes) {
  if (!has_client_ || bytes.empty()) return 0;
  const ssize_t count = ::write(master_, bytes.data(), bytes.size());
  return count > 0 ? static_cast<std::size_t>(count) : 0;
}

}  // namespace cornerd::replay
