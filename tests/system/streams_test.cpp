// SPDX-License-Identifier: MIT
// Faults of the log's target do not affect the poses.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <pty.h>
#include <signal.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <filesystem>
#include <string>
#include <thread>

#include "daemon/require_fd.hpp"
#include "daemon_process.hpp"
#include "tests/wait_until.hpp"

namespace cornerd::system_test {
namespace {

using ::testing::ContainsRegex;

class Streams : public DaemonTest {
 protected:
  /// Makes the daemon log by a reload.
  void reload(const DaemonProcess& daemon) {
    TestClient client = connect();
    client.send(R"({"class":"WATCH","classes":["POSE","EVENT"]})"
                "\n");
    daemon.send_signal(SIGHUP);
    EXPECT_TRUE(next_event(client, "map loaded").is_object());
    EXPECT_EQ(next_of(client, "POSE")["class"], "POSE");
  }

  void serve(const DaemonProcess& daemon) {
    TestClient client = connect();
    next_of(client, "POSE");
    for (int i = 0; i < 3; ++i) reload(daemon);
  }

  void expect_service(DaemonProcess& daemon) {
    serve(daemon);
    daemon.send_signal(SIGTERM);
    EXPECT_EQ(daemon.wait_for_exit(), 0);
  }

  /// Writes until the buffer is full. Returns the number of bytes.
  static std::size_t fill(int fd) {
    std::array<char, 4096> block{};
    std::size_t sum = 0;
    for (std::size_t size = block.size(); size > 0;) {
      const ssize_t written = ::write(fd, block.data(), size);
      if (written > 0) sum += static_cast<std::size_t>(written);
      if (written <= 0) size /= 2;
    }
    return sum;
  }

  /// Reads without waiting.
  static std::string drain(int fd) {
    std::string all;
    std::array<char, 4096> block{};
    for (ssize_t size = 0; (size = ::read(fd, block.data(), block.size())) > 0;) {
      all.append(block.data(), static_cast<std::size_t>(size));
    }
    return all;
  }
};

TEST_F(Streams, ClosedStreams_DescriptorsNotReused) {
  DaemonProcess daemon(with_config(), "");
  connect();
  const std::filesystem::path descriptors = "/proc/" + std::to_string(daemon.pid()) + "/fd";
  for (const char* fd : {"0", "1", "2"}) {
    EXPECT_EQ(std::filesystem::read_symlink(descriptors / fd), "/dev/null");
  }
  expect_service(daemon);
}

TEST_F(Streams, FullDisk_OnlyLogLost) {
  DaemonProcess daemon(with_config(), "/dev/full");
  expect_service(daemon);
}

TEST_F(Streams, StalledLogReader_NotWaitedFor) {
  const std::filesystem::path pipe = folder_ / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  const daemon::FileDescriptor reader(::open(pipe.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC));
  const daemon::FileDescriptor writer(::open(pipe.c_str(), O_WRONLY | O_NONBLOCK | O_CLOEXEC));
  const std::size_t stuffed = fill(writer.get());
  DaemonProcess daemon(with_config(), pipe);
  serve(daemon);
  const std::string rest = drain(reader.get()).substr(stuffed);
  EXPECT_EQ(rest, "") << "no line may be dropped";
  reload(daemon);
  std::string log;  // with the next line: that of further reloads, ten seconds after one's
  EXPECT_TRUE(test::wait_until([&] { return !(log += drain(reader.get())).empty(); }));
  EXPECT_THAT(log, ContainsRegex("warning: [0-9]+ log messages were dropped"));
  fill(writer.get());
  daemon.send_signal(SIGTERM);
  EXPECT_EQ(daemon.wait_for_exit(), 0);
}

TEST_F(Streams, StalledTerminal_NotWaitedFor) {
  int master = -1;
  int slave = -1;
  std::array<char, 64> name{};
  ASSERT_EQ(::openpty(&master, &slave, name.data(), nullptr, nullptr), 0);
  const daemon::FileDescriptor screen(master);
  const daemon::FileDescriptor line(slave);
  ::fcntl(line.get(), F_SETFL, O_NONBLOCK);
  // The kernel transfers data to the master side gradually.
  while (fill(line.get()) > 0) std::this_thread::sleep_for(std::chrono::milliseconds(20));
  DaemonProcess daemon(with_config(), name.data());
  serve(daemon);
  daemon.send_signal(SIGTERM);
  EXPECT_EQ(daemon.wait_for_exit(), 0);
}

TEST_F(Streams, LogReaderCloses_DaemonContinues) {
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
