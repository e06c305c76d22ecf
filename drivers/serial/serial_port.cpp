// SPDX-License-Identifier: MIT
#include "drivers/serial/serial_port.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/file.h>
#include <sys/ioctl.h>
#include <termios.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <limits>
#include <optional>
#include <thread>
#include <utility>

#include "drivers/config/open_files.hpp"
#include "drivers/serial/baud_rate.hpp"
#include "drivers/serial/file_descriptor.hpp"

namespace cornerd::drivers {
namespace {

constexpr int kWriteTimeoutMs = 500;
/// Until collect_for() is called.
constexpr std::chrono::milliseconds kCollect{5};

class SerialPort : public ByteStream {
 public:
  explicit SerialPort(FileDescriptor fd) : fd_(std::move(fd)) {}
  // A pseudo-terminal whose other end is open outlives the close, and would stay exclusive.
  ~SerialPort() override { ::ioctl(fd_.get(), TIOCNXCL); }
  SerialPort(const SerialPort&) = delete;
  SerialPort& operator=(const SerialPort&) = delete;

  ReadResult read(std::span<std::uint8_t> buffer, std::chrono::milliseconds timeout) override {
    if (is_streaming_) {
      std::this_thread::sleep_for(std::min(timeout, collect_));
      const ssize_t count = ::read(fd_.get(), buffer.data(), buffer.size());
      if (count > 0) return data(count, buffer.size());
    }
    is_streaming_ = false;
    pollfd entry{.fd = fd_.get(), .events = POLLIN, .revents = 0};
    const int timeout_ms = static_cast<int>(
        std::clamp<std::int64_t>(timeout.count(), 0, std::numeric_limits<int>::max()));
    const int ready = ::poll(&entry, 1, timeout_ms);
    if (ready < 0) return {errno == EINTR ? ReadStatus::kTimeout : ReadStatus::kLost, 0};
    if (ready == 0) return {};
    // Bytes received before a hang-up can still be read.
    const ssize_t count = ::read(fd_.get(), buffer.data(), buffer.size());
    if (count > 0) return data(count, buffer.size());
    const bool nothing_yet = count == 0 ? (entry.revents & (POLLHUP | POLLERR | POLLNVAL)) == 0
                                        : errno == EAGAIN || errno == EINTR;
    return {nothing_yet ? ReadStatus::kTimeout : ReadStatus::kLost, 0};
  }

  void collect_for(std::chrono::milliseconds duration) override { collect_ = duration; }

  bool write(std::span<const std::uint8_t> bytes) override {
    while (!bytes.empty()) {
      const ssize_t count = ::write(fd_.get(), bytes.data(), bytes.size());
      if (count > 0) {
        bytes = bytes.subspan(static_cast<std::size_t>(count));
      } else if (count < 0 && errno == EINTR) {
        continue;
      } else if (count < 0 && errno == EAGAIN) {
        pollfd entry{.fd = fd_.get(), .events = POLLOUT, .revents = 0};
        const int ready = ::poll(&entry, 1, kWriteTimeoutMs);
        if (ready == 0 || (ready < 0 && errno != EINTR)) return false;
      } else {
        return false;
      }
    }
    return true;
  }

  void discard_input() override { ::tcflush(fd_.get(), TCIFLUSH); }

  bool set_dtr(bool asserted) override {
    int line = TIOCM_DTR;
    return ::ioctl(fd_.get(), asserted ? TIOCMBIS : TIOCMBIC, &line) == 0;
  }

 private:
  ReadResult data(ssize_t count, std::size_t most) {
    is_streaming_ = static_cast<std::size_t>(count) < most;
    return {ReadStatus::kData, static_cast<std::size_t>(count)};
  }

  FileDescriptor fd_;
  std::chrono::milliseconds collect_ = kCollect;
  bool is_streaming_ = false;  ///< the last read emptied the port: more bytes follow
};

OpenResult failure(OpenError error, const std::string& path, const std::string& reason) {
  return {.stream = nullptr, .error = error, .message = path + ": " + reason};
}

/// open() fails with EPERM if the service's control group forbids this kind of device.
std::string forbidden_kind(const std::string& path) {
  std::error_code error;
  const auto port = std::filesystem::canonical(path, error);
  // The kernel's name for the kind, as in /proc/devices.
  std::string kind = (error ? std::filesystem::path(path) : port).filename().string();
  kind.erase(kind.find_last_not_of("0123456789") + 1);
  return "the service's unit forbids it; run `sudo systemctl edit cornerd` and write [Service] and "
         "below it DeviceAllow=char-" +
         kind + " rw";
}

OpenResult explain_open_failure(const std::string& path, int error) {
  switch (error) {
    case ENOENT:
    case ENODEV:
    case ENXIO:
      return failure(OpenError::kAbsent, path, "no such port");
    case EPERM:
      return failure(OpenError::kDenied, path, forbidden_kind(path));
    case EACCES:
      return failure(OpenError::kDenied, path,
                     "no permission to open it; add the user to the group dialout");
    case EBUSY:
      return failure(OpenError::kBusy, path, "held by another process");
    default:
      return failure(OpenError::kFailed, path, std::strerror(error) + open_files_hint(error));
  }
}

/// The constant of a standard rate; QEMU's user mode has no other.
std::optional<speed_t> standard_speed(std::uint32_t baud) {
  switch (baud) {
    case 9600:
      return B9600;
    case 19200:
      return B19200;
    case 38400:
      return B38400;
    case 57600:
      return B57600;
    case 115200:
      return B115200;
    case 230400:
      return B230400;
    case 460800:
      return B460800;
    case 921600:
      return B921600;
    case 1000000:
      return B1000000;
    default:
      return std::nullopt;
  }
}

bool make_raw(int fd, std::uint32_t baud) {
  termios settings{};
  if (::tcgetattr(fd, &settings) != 0) return false;
  ::cfmakeraw(&settings);
  settings.c_iflag &= ~static_cast<tcflag_t>(IXOFF | IXANY | INPCK);
  settings.c_iflag |= IGNBRK;
  settings.c_cflag &= ~static_cast<tcflag_t>(CSIZE | CSTOPB | PARENB | CRTSCTS | HUPCL);
  settings.c_cflag |= CS8 | CLOCAL | CREAD;
  settings.c_cc[VMIN] = 0;
  settings.c_cc[VTIME] = 0;
  const auto standard = standard_speed(baud);
  if (standard && ::cfsetspeed(&settings, *standard) != 0) return false;
  return ::tcsetattr(fd, TCSANOW, &settings) == 0 && (standard || set_baud_rate(fd, baud));
}

}  // namespace

OpenResult open_serial_port(const std::string& path, std::uint32_t baud) {
  FileDescriptor fd(::open(path.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC));
  if (!fd.is_open()) return explain_open_failure(path, errno);
  if (::isatty(fd.get()) == 0) return failure(OpenError::kFailed, path, "not a serial port");
  if (::flock(fd.get(), LOCK_EX | LOCK_NB) != 0) {
    if (errno != EWOULDBLOCK) return failure(OpenError::kFailed, path, std::strerror(errno));
    return failure(OpenError::kBusy, path, "held by another process");
  }
  if (::ioctl(fd.get(), TIOCEXCL) != 0 || !make_raw(fd.get(), baud)) {
    return failure(OpenError::kFailed, path, std::strerror(errno));
  }
  ::tcflush(fd.get(), TCIOFLUSH);
  return {.stream = std::make_unique<SerialPort>(std::move(fd)),
          .error = OpenError::kNone,
          .message = {}};
}

}  // namespace cornerd::drivers
