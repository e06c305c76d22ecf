// SPDX-License-Identifier: MIT
// As many clients as there may be, a third of them ill-behaved: the others miss nothing.
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <optional>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "daemon_process.hpp"
#include "tests/sanitized.hpp"

namespace cornerd::system_test {
namespace {

constexpr int kReaders = 19;
constexpr int kSilent = 8;
constexpr int kBabblers = 4;
constexpr std::uint64_t kPoses = 30;
constexpr std::uint64_t kFlatBytes = 1 << 20;

/// Reads poses without a break, and sees whether one is missing.
struct Reader {
  TestClient client;
  std::uint64_t last = 0;
  std::uint64_t poses = 0;

  void take(const json& message) {
    if (message["class"] != "POSE") return;
    EXPECT_EQ(message.value("dropped", 0u), 0u);
    if (last != 0) {
      EXPECT_EQ(message["seq"].get<std::uint64_t>(), last + 1);
    }
    last = message["seq"];
    ++poses;
  }
};

class Clients : public DaemonTest {
 protected:
  static std::uint64_t resident_bytes(const DaemonProcess& daemon) {
    std::uint64_t size = 0;
    std::uint64_t resident = 0;
    std::ifstream("/proc/" + std::to_string(daemon.pid()) + "/statm") >> size >> resident;
    return resident * 4096;
  }
  static std::ptrdiff_t descriptors(const DaemonProcess& daemon) {
    const std::filesystem::directory_iterator all("/proc/" + std::to_string(daemon.pid()) + "/fd");
    return std::distance(begin(all), end(all));
  }
};

TEST_F(Clients, ThirtyTwoOfAllKinds_LeaveTheReadersTheirPoses) {
  const DaemonProcess daemon = start({"/lidar/speed=1"});
  std::vector<Reader> readers;
  for (int i = 0; i < kReaders; ++i) readers.push_back({connect()});
  std::vector<TestClient> silent;
  for (int i = 0; i < kSilent; ++i) silent.push_back(connect());
  std::vector<TestClient> babblers;
  for (int i = 0; i < kBabblers; ++i) babblers.push_back(connect());

  std::atomic<std::uint64_t> visits{0};
  const std::jthread visitor([&](const std::stop_token& stop) {
    while (!stop.stop_requested()) {
      const TestClient visit(folder_ / "pose.sock");
      ++visits;
      std::this_thread::sleep_for(std::chrono::milliseconds(test::kSanitized ? 10 : 1));
    }
  });
  const std::jthread babble([&](const std::stop_token& stop) {
    std::minstd_rand random(1);
    while (!stop.stop_requested()) {
      for (TestClient& client : babblers) {
        std::string garbage(100, '\n');
        for (std::size_t i = 0; i + 1 < garbage.size(); ++i) {
          garbage[i] = static_cast<char>(random());
        }
        client.offer(garbage);
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(test::kSanitized ? 100 : 2));
    }
  });

  std::uint64_t warm_bytes = 0;
  std::ptrdiff_t warm_descriptors = 0;
  while (readers.front().poses < kPoses) {
    for (Reader& reader : readers) {
      const auto line = reader.client.read_line(60'000);
      ASSERT_TRUE(line);
      reader.take(json::parse(*line));
    }
    if (warm_bytes == 0 && readers.front().poses > kPoses / 3) {
      warm_bytes = resident_bytes(daemon);
      warm_descriptors = descriptors(daemon);
    }
  }
  if (!test::kSanitized) {
    EXPECT_LT(resident_bytes(daemon), warm_bytes + kFlatBytes);
  }
  EXPECT_NEAR(static_cast<double>(descriptors(daemon)), static_cast<double>(warm_descriptors), 3);
  EXPECT_GT(visits, 20u);

  // Who did not read gets the newest, and is told what it lost.
  std::uint64_t dropped = 0;
  std::uint64_t newest = 0;
  while (newest + 3 < readers.front().last) {
    const json message = next(silent.front());
    ASSERT_TRUE(message.is_object());
    dropped += message["class"] == "POSE" ? message.value("dropped", 0u) : 0u;
    newest = message["class"] == "POSE" ? message["seq"].get<std::uint64_t>() : newest;
  }
  EXPECT_GT(dropped, 0u);
}

TEST_F(Clients, OneTooMany_IsToldSo) {
  const DaemonProcess daemon = start();
  std::vector<TestClient> clients;
  for (int i = 0; i < 32; ++i) {
    clients.push_back(connect());
    EXPECT_EQ(next(clients.back())["class"], "VERSION");
  }
  TestClient last = connect();
  const json error = next(last);
  EXPECT_EQ(error["class"], "ERROR");
  EXPECT_EQ(error["code"], "too-many-clients");
  EXPECT_FALSE(next(last).is_object()) << "it is sent away";
  EXPECT_EQ(next_of(clients.front(), "POSE")["class"], "POSE");
}

}  // namespace
}  // namespace cornerd::system_test
