// SPDX-License-Identifier: MIT
#include "replay/emulator/pty_emulator.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <unistd.h>

#include <atomic>
#include <fstream>
#include <string>
#include <system_error>
#include <thread>
#include <vector>

#include "tests/temporary_folder.hpp"
#include "tests/unit/replay/hex.hpp"
#include "tests/unit/replay/test_maps.hpp"
#include "tests/wait_until.hpp"

namespace cornerd::replay {
namespace {

/// Longer than any answer takes; reached only if the test fails.
constexpr int kTimeoutMs = 20'000;

/// A program with the port open.
class Client {
 public:
  explicit Client(const std::filesystem::path& port)
      : port_(::open(port.c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC)) {}
  ~Client() { ::close(port_); }
  Client(const Client&) = delete;
  Client& operator=(const Client&) = delete;

  bool is_open() const { return port_ >= 0; }
  void send(const std::string& hex) {
    const auto bytes = from_hex(hex);
    ASSERT_EQ(::write(port_, bytes.data(), bytes.size()), static_cast<ssize_t>(bytes.size()));
  }
  /// Reads until the bytes have arrived. False on a timeout.
  bool receive(const std::string& hex) {
    std::string received;
    pollfd readable{port_, POLLIN, 0};
    while (received.find(hex) == std::string::npos) {
      if (::poll(&readable, 1, kTimeoutMs) <= 0) return false;
      std::uint8_t buffer[256];
      const ssize_t count = ::read(port_, buffer, sizeof buffer);
      if (count <= 0) return false;
      received += to_hex({buffer, static_cast<std::size_t>(count)});
    }
    return true;
  }

 private:
  int port_;
};

std::unique_ptr<DeviceEmulator> make_emulator() {
  return std::make_unique<Emulator>(
      EmulatorConfig{},
      std::make_unique<Simulator>(std::make_unique<MapScene>(make_room(), stand_still({1, 1, 0})),
                                  SimulatorConfig{}));
}

class PtyEmulatorTest : public ::testing::Test {
 protected:
  PtyEmulatorTest() : emulator_(make_emulator(), folder_.path() / "port") {
    emulator_.set_on_time([this](core::TimeNs t_ns, core::TimeNs unix_ns) {
      last_unix_ns_ = unix_ns;
      last_t_ns_ = t_ns;
    });
    thread_ = std::jthread([this](const std::stop_token& stop) { emulator_.run(stop); });
  }

  void stop() {
    thread_.request_stop();
    thread_.join();
  }

  /// Whether the emulator's own time passes that.
  bool time_passes(double t_s) {
    return test::wait_until([&] { return last_t_ns_ >= core::from_seconds(t_s); });
  }

  test::TemporaryFolder folder_;
  PtyEmulator emulator_;
  std::atomic<core::TimeNs> last_t_ns_ = -1;
  std::atomic<core::TimeNs> last_unix_ns_ = -1;
  std::jthread thread_;
};

TEST_F(PtyEmulatorTest, SuccessiveClients_GetNoStaleBytes) {
  for (int i = 0; i < 3; ++i) {
    Client client(folder_.path() / "port");
    ASSERT_TRUE(client.is_open());
    client.send("a552");
    EXPECT_TRUE(client.receive("a55a0300000006000000"));
    client.send("a520");
    EXPECT_TRUE(client.receive("a55a0500004081"));
  }
}

TEST_F(PtyEmulatorTest, NoClient_TimeContinues) {
  {
    Client client(folder_.path() / "port");
    client.send("a552");
    EXPECT_TRUE(client.receive("a55a0300000006000000"));
  }
  const core::TimeNs then_ns = last_t_ns_;
  ASSERT_TRUE(time_passes(core::to_seconds(then_ns) + 0.02));
  stop();
  EXPECT_GT(last_unix_ns_, core::TimeNs{1'600'000'000} * core::kNsPerSecond);
}

TEST_F(PtyEmulatorTest, ClientNotReading_DoesNotBlock) {
  Client client(folder_.path() / "port");
  client.send("a58205030000000021");
  // The terminal holds 4 kB: express scans fill them in less.
  ASSERT_TRUE(time_passes(0.4));
}

TEST(PseudoTerminal, Link_IsReplacedAndRemovedAtTheEnd) {
  const test::TemporaryFolder folder;
  const auto link = folder.path() / "port";
  std::filesystem::create_symlink("/nonexistent", link);
  {
    const PseudoTerminal terminal(link);
    EXPECT_EQ(std::filesystem::read_symlink(link), terminal.path());
  }
  EXPECT_FALSE(std::filesystem::is_symlink(std::filesystem::symlink_status(link)));
}

TEST(PseudoTerminal, FileAtTheLinksPath_IsKept) {
  const test::TemporaryFolder folder;
  const auto link = folder.path() / "port";
  std::ofstream(link) << "precious";
  EXPECT_THROW(PseudoTerminal{link}, std::system_error);
  EXPECT_TRUE(std::filesystem::is_regular_file(link));
}

TEST(PseudoTerminal, LinkInMissingFolder_IsNamed) {
  try {
    const PseudoTerminal terminal("/nowhere/port");
    ADD_FAILURE() << "made";
  } catch (const std::system_error& error) {
    EXPECT_EQ(std::string(error.what()).find("/nowhere/port: cannot be made"), 0u) << error.what();
  }
}

}  // namespace
}  // namespace cornerd::replay
