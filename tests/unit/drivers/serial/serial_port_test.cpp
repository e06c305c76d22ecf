// SPDX-License-Identifier: MIT
#include "drivers/serial/serial_port.hpp"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <stdlib.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <termios.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <vector>

#include "drivers/serial/baud_rate.hpp"
#include "drivers/serial/byte_stream.hpp"
#include "drivers/serial/file_descriptor.hpp"
#include "tests/temporary_folder.hpp"

namespace cornerd::drivers {
namespace {

using std::chrono::milliseconds;
using Bytes = std::vector<std::uint8_t>;
using Status = ByteStream::ReadStatus;

/// The far end of a pseudo-terminal.
class PtyMaster {
 public:
  PtyMaster() : fd_(::posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC)) {
    ::grantpt(fd_.get());
    ::unlockpt(fd_.get());
    std::array<char, 64> name{};
    ::ptsname_r(fd_.get(), name.data(), name.size());
    path = name.data();
  }

  void write(const Bytes& bytes) {
    ASSERT_EQ(::write(fd_.get(), bytes.data(), bytes.size()), static_cast<ssize_t>(bytes.size()));
  }

  Bytes read(std::size_t count) {
    Bytes bytes(count);
    const ssize_t got = ::read(fd_.get(), bytes.data(), bytes.size());
    bytes.resize(got > 0 ? static_cast<std::size_t>(got) : 0);
    return bytes;
  }

  void hang_up() { fd_ = FileDescriptor(); }
  std::uint32_t baud() const { return baud_rate(fd_.get()); }

  std::string path;

 private:
  FileDescriptor fd_;
};

Bytes read_all(ByteStream& port, std::size_t count) {
  Bytes all;
  std::array<std::uint8_t, 64> buffer{};
  while (all.size() < count) {
    const auto [status, got] = port.read(buffer, milliseconds(2000));
    if (status != Status::kData) break;
    all.insert(all.end(), buffer.begin(), buffer.begin() + static_cast<std::ptrdiff_t>(got));
  }
  return all;
}

TEST(SerialPort, EveryByteValue_PassesBothWays) {
  PtyMaster master;
  const auto opened = open_serial_port(master.path, 115200);
  ASSERT_NE(opened.stream, nullptr) << opened.message;
  Bytes bytes(256);
  for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<std::uint8_t>(i);
  // Characters that a cooked terminal acts on.
  for (const int special : {0x03, 0x04, 0x0A, 0x0D, 0x11, 0x13, 0x1A, 0xFF, 0xFF}) {
    bytes.push_back(static_cast<std::uint8_t>(special));
  }
  master.write(bytes);
  EXPECT_EQ(read_all(*opened.stream, bytes.size()), bytes);
  ASSERT_TRUE(opened.stream->write(bytes));
  EXPECT_EQ(master.read(1000), bytes);
}

TEST(SerialPort, NoInput_IsATimeout) {
  PtyMaster master;
  const auto opened = open_serial_port(master.path, 115200);
  std::array<std::uint8_t, 8> buffer{};
  EXPECT_EQ(opened.stream->read(buffer, milliseconds(1)).status, Status::kTimeout);
}

TEST(SerialPort, HangUp_IsReportedAfterTheLastBytes) {
  PtyMaster master;
  const auto opened = open_serial_port(master.path, 115200);
  master.write({1, 2, 3});
  EXPECT_EQ(read_all(*opened.stream, 3), (Bytes{1, 2, 3}));
  master.hang_up();
  std::array<std::uint8_t, 8> buffer{};
  EXPECT_EQ(opened.stream->read(buffer, milliseconds(2000)).status, Status::kLost);
  EXPECT_FALSE(opened.stream->write(Bytes{1}));
}

TEST(SerialPort, DiscardInput_DropsUnreadBytes) {
  PtyMaster master;
  const auto opened = open_serial_port(master.path, 115200);
  master.write({1, 2, 3});
  std::array<std::uint8_t, 1> first{};
  ASSERT_EQ(opened.stream->read(first, milliseconds(2000)).count, 1U);
  opened.stream->discard_input();
  EXPECT_EQ(opened.stream->read(first, milliseconds(1)).status, Status::kTimeout);
}

TEST(SerialPort, SecondOpener_IsRefused) {
  PtyMaster master;
  const auto first = open_serial_port(master.path, 115200);
  ASSERT_NE(first.stream, nullptr);
  const auto second = open_serial_port(master.path, 115200);
  EXPECT_EQ(second.stream, nullptr);
  EXPECT_EQ(second.error, OpenError::kBusy);
  EXPECT_EQ(second.message, master.path + ": held by another process");
}

TEST(SerialPort, ClosedPort_CanBeOpenedAgain) {
  PtyMaster master;
  open_serial_port(master.path, 115200);
  EXPECT_NE(open_serial_port(master.path, 115200).stream, nullptr);
  // Programs that do not use flock can open it too.
  EXPECT_TRUE(FileDescriptor(::open(master.path.c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC)).is_open());
}

TEST(SerialPort, MissingPort_IsNamed) {
  const auto opened = open_serial_port("/dev/no-such-port", 115200);
  EXPECT_EQ(opened.error, OpenError::kAbsent);
  EXPECT_EQ(opened.message, "/dev/no-such-port: no such port");
}

TEST(SerialPort, NoTerminal_IsRefused) {
  const auto opened = open_serial_port("/dev/null", 115200);
  EXPECT_EQ(opened.error, OpenError::kFailed);
  EXPECT_EQ(opened.message, "/dev/null: not a serial port");
}

TEST(SerialPort, AnyBaud_IsSet) {
  PtyMaster master;
  for (const std::uint32_t baud : {9'600U, 115'200U, 128'000U, 256'000U, 1'000'000U, 12'345U}) {
    const auto opened = open_serial_port(master.path, baud);
    ASSERT_TRUE(opened.stream) << opened.message;
    EXPECT_EQ(master.baud(), baud);
  }
}

TEST(SerialPort, NoPermission_IsDenied) {
  PtyMaster master;
  std::filesystem::permissions(master.path, std::filesystem::perms::none);
  const pid_t child = ::fork();
  if (child == 0) {
    constexpr uid_t kNobody = 65534;
    if (::geteuid() == 0 && ::setuid(kNobody) != 0) ::_exit(2);
    ::_exit(open_serial_port(master.path, 115200).error == OpenError::kDenied ? 0 : 1);
  }
  int status = -1;
  ::waitpid(child, &status, 0);
  EXPECT_EQ(status, 0);
}

/// Makes open() fail with EPERM, as a control group does. False if seccomp is unavailable.
bool forbid_opening() {
  sock_filter steps[] = {
      BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, nr)),
      BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, __NR_openat, 0, 1),
      BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ERRNO | EPERM),
      BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW),
  };
  const sock_fprog filter{.len = static_cast<unsigned short>(std::size(steps)), .filter = steps};
  return ::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 &&
         ::prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &filter) == 0;
}

TEST(SerialPort, DeviceForbiddenByTheUnit_NamesTheSetting) {
  const test::TemporaryFolder folder;
  const std::filesystem::path port = folder.path() / "ttyXY12";
  std::ofstream(port) << "";
  const std::filesystem::path link = folder.path() / "rplidar";
  std::filesystem::create_symlink(port, link);
  const pid_t child = ::fork();
  if (child == 0) {
    if (!forbid_opening()) ::_exit(77);
    const auto opened = open_serial_port(link.string(), 115200);
    const bool is_told = opened.error == OpenError::kDenied &&
                         opened.message.find("DeviceAllow=char-ttyXY rw") != std::string::npos &&
                         opened.message.find("dialout") == std::string::npos;
    ::_exit(is_told ? 0 : 1);
  }
  int status = -1;
  ::waitpid(child, &status, 0);
  if (WIFEXITED(status) && WEXITSTATUS(status) == 77) GTEST_SKIP() << "no seccomp here";
  EXPECT_EQ(status, 0);
}

TEST(SerialPort, PseudoTerminal_HasNoDtr) {
  PtyMaster master;
  EXPECT_FALSE(open_serial_port(master.path, 115200).stream->set_dtr(true));
}

TEST(RecordingByteStream, BothDirections_AreObserved) {
  PtyMaster master;
  std::vector<std::pair<RecordingByteStream::Direction, Bytes>> seen;
  RecordingByteStream port(
      open_serial_port(master.path, 115200).stream,
      [&](RecordingByteStream::Direction direction, std::span<const std::uint8_t> bytes) {
        seen.emplace_back(direction, Bytes(bytes.begin(), bytes.end()));
      });
  ASSERT_TRUE(port.write(Bytes{0xA5, 0x50}));
  master.write({0xA5, 0x5A});
  EXPECT_EQ(read_all(port, 2), (Bytes{0xA5, 0x5A}));
  ASSERT_EQ(seen.size(), 2U);
  EXPECT_EQ(seen[0].first, RecordingByteStream::Direction::kSent);
  EXPECT_EQ(seen[0].second, (Bytes{0xA5, 0x50}));
  EXPECT_EQ(seen[1].first, RecordingByteStream::Direction::kReceived);
}

}  // namespace
}  // namespace cornerd::drivers
