// SPDX-License-Identifier: MIT
// The maximum number of clients, a third of them misbehaving: the others miss no pose. Prints the
// latency of the daemon's loops without and with them. CORNERD_POSES=300 runs longer:
//   build/test/tests/system_daemon --gtest_filter='Clients.*' | grep '^|'
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
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
#include "emulated_lidar.hpp"
#include "heartbeat.hpp"
#include "tests/sanitized.hpp"

namespace cornerd::system_test {
namespace {

constexpr int kReaders = 19;
constexpr int kSilent = 8;
constexpr int kBabblers = 4;
constexpr std::uint64_t kFlatBytes = 1 << 20;

/// Poses of each half, without and with the misbehaving clients.
std::uint64_t poses_to_read() {
  const char* poses = std::getenv("CORNERD_POSES");
  return poses == nullptr ? 20 : std::strtoull(poses, nullptr, 10);
}

using Clock = std::chrono::steady_clock;

/// Reads poses continuously and checks that none is missing.
struct Reader {
  TestClient client;
  const Heartbeat* heartbeat;
  std::uint64_t last = 0;
  std::uint64_t poses = 0;
  json realtime = json::object();  ///< of the newest STATUS

  void take(const json& message) {
    if (message["class"] == "STATUS") realtime = message["realtime"];
    if (message["class"] != "POSE") return;
    const std::uint64_t dropped = message.value("dropped", 0u);
    EXPECT_TRUE(dropped == 0 || heartbeat->stood_still_lately()) << message;
    if (last != 0) {
      EXPECT_EQ(message["seq"].get<std::uint64_t>(), last + 1 + dropped);
    }
    last = message["seq"];
    ++poses;
  }
};

/// The misbehaving clients, until destroyed.
class Crowd {
 public:
  explicit Crowd(std::filesystem::path socket) : socket_(std::move(socket)) {
    for (int i = 0; i < kSilent; ++i) silent_.emplace_back(socket_);
    for (int i = 0; i < kBabblers; ++i) babblers_.emplace_back(socket_);
    visitor_ = std::jthread([this](const std::stop_token& stop) { visit(stop); });
    babble_ = std::jthread([this](const std::stop_token& stop) { babble(stop); });
  }

  TestClient& a_silent_one() { return silent_.front(); }
  std::uint64_t visits() const { return visits_; }
  double visits_per_s() const {
    return static_cast<double>(visits_) /
           std::chrono::duration<double>(Clock::now() - began_).count();
  }

 private:
  /// 1,000 times per second; a late round is made up for.
  void visit(const std::stop_token& stop) {
    for (auto next = began_; !stop.stop_requested(); std::this_thread::sleep_until(next)) {
      const TestClient visit(socket_);
      ++visits_;
      next += std::chrono::milliseconds(test::kSanitized ? 10 : 1);
    }
  }

  void babble(const std::stop_token& stop) {
    std::minstd_rand random(1);
    while (!stop.stop_requested()) {
      for (TestClient& client : babblers_) {
        std::string garbage(100, '\n');
        for (std::size_t i = 0; i + 1 < garbage.size(); ++i) {
          garbage[i] = static_cast<char>(random());
        }
        client.offer(garbage);
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(test::kSanitized ? 100 : 2));
    }
  }

  const std::filesystem::path socket_;
  std::vector<TestClient> silent_;
  std::vector<TestClient> babblers_;
  const Clock::time_point began_ = Clock::now();
  std::atomic<std::uint64_t> visits_{0};
  std::jthread visitor_;
  std::jthread babble_;
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

  static void read(std::vector<Reader>& readers, std::uint64_t poses) {
    const std::uint64_t until = readers.front().poses + poses;
    while (readers.front().poses < until) {
      for (Reader& reader : readers) {
        const auto line = reader.client.read_line(60'000);
        ASSERT_TRUE(line) << "a reader got no line";
        reader.take(json::parse(*line));
      }
    }
  }

  /// The edge in milliseconds below which this share of the counts lies.
  static std::string within(const std::vector<std::uint64_t>& counts, const json& edges,
                            double share) {
    std::uint64_t all = 0;
    for (const std::uint64_t count : counts) all += count;
    const auto wanted = static_cast<double>(all) * share;
    std::uint64_t so_far = 0;
    for (std::size_t i = 0; i < edges.size(); ++i) {
      so_far += counts[i];
      if (static_cast<double>(so_far) >= wanted) return edges[i].dump();
    }
    return "more";
  }

  /// Latency of each loop between two STATUS.
  static void print(const char* when, const json& from, const json& to) {
    for (const char* loop : {"reader", "localizer", "server"}) {
      std::vector<std::uint64_t> counts = to[loop]["counts"];
      if (from.contains(loop)) {
        const std::vector<std::uint64_t> before = from[loop]["counts"];
        for (std::size_t i = 0; i < counts.size(); ++i) counts[i] -= before[i];
      }
      std::printf("| %-9s | %-7s | %6s s | %6s s | %6s s |\n", loop, when,
                  within(counts, to["edges"], 0.5).c_str(),
                  within(counts, to["edges"], 0.99).c_str(),
                  within(counts, to["edges"], 1).c_str());
    }
    std::fflush(stdout);
  }
};

TEST_F(Clients, ThirtyTwoOfAllKinds_ReadersMissNoPose) {
  const EmulatedLidar lidar(folder_ / "map.json", folder_ / "lidar");
  const DaemonProcess daemon =
      start({"/lidar/driver=rplidar", "/lidar/device=" + (folder_ / "lidar").string(),
             "/advanced/realtime/priority=50", "/advanced/realtime/lock_memory=true"});
  const Heartbeat heartbeat;
  std::vector<Reader> readers;
  for (int i = 0; i < kReaders; ++i) readers.push_back({connect(), &heartbeat});
  const std::uint64_t poses = poses_to_read();
  read(readers, poses);
  if (HasFatalFailure()) return;
  const json alone = readers.front().realtime;

  auto crowd = std::make_unique<Crowd>(folder_ / "pose.sock");
  read(readers, poses / 3);
  if (HasFatalFailure()) return;
  const std::uint64_t warm_bytes = resident_bytes(daemon);
  const std::ptrdiff_t warm_descriptors = descriptors(daemon);
  read(readers, poses);
  if (HasFatalFailure()) return;
  const std::uint64_t end_bytes = resident_bytes(daemon);
  const std::ptrdiff_t end_descriptors = descriptors(daemon);

  std::printf("%.0f visits a second; resident memory %llu kB, then %llu kB; descriptors %td, %td\n",
              crowd->visits_per_s(), static_cast<unsigned long long>(warm_bytes / 1024),
              static_cast<unsigned long long>(end_bytes / 1024), warm_descriptors, end_descriptors);
  print("without", json::object(), alone);
  print("with", alone, readers.front().realtime);
  if (!test::kSanitized) {
    EXPECT_LT(end_bytes, warm_bytes + kFlatBytes);
  }
  // One client that connects and disconnects may be connected at this moment.
  EXPECT_NEAR(static_cast<double>(end_descriptors), static_cast<double>(warm_descriptors), 3);
  EXPECT_GT(crowd->visits(), 20u);

  // A client that did not read gets the newest line and the number dropped.
  std::uint64_t dropped = 0;
  std::uint64_t newest = 0;
  while (newest + 3 < readers.front().last) {
    const json message = next(crowd->a_silent_one());
    ASSERT_TRUE(message.is_object());
    dropped += message["class"] == "POSE" ? message.value("dropped", 0u) : 0u;
    newest = message["class"] == "POSE" ? message["seq"].get<std::uint64_t>() : newest;
  }
  EXPECT_GT(dropped, 0u);
}

TEST_F(Clients, TooManyClients_Refused) {
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
  EXPECT_FALSE(next(last).is_object()) << "it is disconnected";
  EXPECT_EQ(next_of(clients.front(), "POSE")["class"], "POSE");
}

}  // namespace
}  // namespace cornerd::system_test
