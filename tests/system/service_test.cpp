// SPDX-License-Identifier: MIT
// Behaviour under a service manager: readiness, watchdog, reload, termination.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/stat.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "daemon_process.hpp"
#include "room_recording.hpp"
#include "service_manager.hpp"
#include "tests/wait_until.hpp"

namespace cornerd::system_test {
namespace {

class Service : public DaemonTest {
 protected:
  static bool has_thread(pid_t pid, const std::string& name) {
    for (const auto& entry :
         std::filesystem::directory_iterator("/proc/" + std::to_string(pid) + "/task")) {
      std::string found;
      std::getline(std::ifstream(entry.path() / "comm"), found);
      if (found == name) return true;
    }
    return false;
  }

  /// `set`: "SigBlk:" or "SigCgt:" of /proc/PID/status. Bit n is signal n + 1.
  static std::uint64_t signals_in(pid_t pid, const std::string& set) {
    std::ifstream status("/proc/" + std::to_string(pid) + "/status");
    for (std::string line; std::getline(status, line);) {
      if (line.starts_with(set)) return std::stoull(line.substr(set.size()), nullptr, 16);
    }
    return 0;
  }
  /// The daemon's first action: before it, SIGHUP ends the process. (fork() and sanitizers block
  /// all signals for a moment.)
  static bool blocks_hangups(pid_t pid) {
    const std::uint64_t blocked = signals_in(pid, "SigBlk:");
    return (blocked & 1U << (SIGHUP - 1)) != 0 && (blocked & 1U << (SIGUSR2 - 1)) == 0;
  }

  /// A map that takes seconds to load: 90,000 crossings of line walls.
  static void write_slow_map(const std::filesystem::path& file) {
    std::ofstream map(file);
    map << R"({ "format": "cornerd-map", "version": 1, "walls": [ )";
    for (int i = 0; i < 300; ++i) {
      const double at = 0.3 * i;
      map << (i > 0 ? "," : "") << "{\"from\": [0, " << at << "], \"to\": [90, " << at
          << "]}, {\"from\": [" << at + 0.1 << ", 0], \"to\": [" << at + 0.1 << ", 90]}";
    }
    map << "] }";
  }

  /// A map that takes a while to load.
  static void write_large_map(const std::filesystem::path& file) {
    std::ofstream map(file);
    map << R"({ "format": "cornerd-map", "version": 1, "walls": [ )";
    for (int i = 0; i < 100; ++i) {
      map << (i > 0 ? "," : "") << "{\"from\": [" << i << ", 0], \"to\": [" << i << ", 1]}";
    }
    map << "] }";
  }
};

TEST_F(Service, Ready_SentWhenSocketsAccept) {
  const std::string path = (folder_ / "notify").string();
  const ServiceManager manager(path);
  const DaemonProcess daemon = start({}, {{"NOTIFY_SOCKET", path}});
  ASSERT_TRUE(manager.hears("READY=1"));
  EXPECT_TRUE(TestClient(folder_ / "pose.sock").is_connected());
  EXPECT_TRUE(TestClient(folder_ / "control.sock").is_connected());
  daemon.send_signal(SIGTERM);
  EXPECT_TRUE(manager.hears("STOPPING=1"));
}

TEST_F(Service, Watchdog_WithoutLidar_Fed) {
  const std::string path = (folder_ / "notify").string();
  const ServiceManager manager(path);
  const DaemonProcess daemon = start({"/lidar/driver=rplidar", "/lidar/device=/dev/no_such_lidar"},
                                     {{"NOTIFY_SOCKET", path}, {"WATCHDOG_USEC", "100000"}});
  for (int i = 0; i < 3; ++i) EXPECT_TRUE(manager.hears("WATCHDOG=1"));
}

class ServiceEnd : public Service, public ::testing::WithParamInterface<int> {};

TEST_P(ServiceEnd, TerminationSignal_EndsCleanlyAndRemovesSockets) {
  DaemonProcess daemon = start();
  TestClient client = connect();
  next_of(client, "POSE");
  daemon.send_signal(GetParam());
  EXPECT_EQ(daemon.wait_for_exit(), 0) << daemon.output();
  EXPECT_FALSE(std::filesystem::exists(folder_ / "pose.sock"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "control.sock"));
}

INSTANTIATE_TEST_SUITE_P(EachSignal, ServiceEnd, ::testing::Values(SIGTERM, SIGINT));

TEST_F(Service, Hangup_MapReloadedAndNoScanMissed) {
  const std::string path = (folder_ / "notify").string();
  const ServiceManager manager(path);
  const DaemonProcess daemon = start({}, {{"NOTIFY_SOCKET", path}});
  ASSERT_TRUE(manager.hears("READY=1"));
  TestClient client = connect();
  client.send(R"({"class":"WATCH","classes":["POSE","EVENT"]})"
              "\n");
  EXPECT_EQ(next_of(client, "POSE")["room"], "only");
  write_map(folder_ / "map.json", "after");
  std::uint64_t last = next_of(client, "POSE")["seq"];
  daemon.send_signal(SIGHUP);
  bool said = false;
  for (json message = next(client); message.is_object(); message = next(client)) {
    said = said || (message["class"] == "EVENT" && message["what"] == "map loaded");
    if (message["class"] != "POSE") continue;
    if (message["room"] == "after") break;
    EXPECT_EQ(message["room"], "only");
    EXPECT_EQ(message["seq"].get<std::uint64_t>(), last + 1 + message.value("dropped", 0u));
    last = message["seq"];
  }
  EXPECT_TRUE(said);
  EXPECT_TRUE(manager.hears("RELOADING=1"));
  EXPECT_TRUE(manager.hears("READY=1"));
}

TEST_F(Service, HangupWithInvalidFile_RefusedWithReason) {
  const DaemonProcess daemon = start();
  TestClient client = connect();
  next_of(client, "POSE");
  client.send(R"({"class":"WATCH","classes":["POSE","EVENT"]})"
              "\n");
  std::ofstream(folder_ / "map.json") << R"({ "format": "cornerd-map", "version": 1 })";
  daemon.send_signal(SIGHUP);
  const json event = next_event(client, "reload refused");
  EXPECT_NE(event["detail"].get<std::string>().find("map.json: /walls"), std::string::npos)
      << event;
  EXPECT_EQ(next_of(client, "POSE")["room"], "only");
  std::ofstream(folder_ / "cornerd.json") << "{ no JSON";
  daemon.send_signal(SIGHUP);
  EXPECT_NE(next_event(client, "reload refused")["detail"].get<std::string>().find("cornerd.json"),
            std::string::npos);
  EXPECT_EQ(next_of(client, "POSE")["room"], "only");
  EXPECT_TRUE(daemon.is_running());
}

TEST_F(Service, HangupWithPipeInsteadOfMap_Refused) {
  DaemonProcess daemon = start();
  TestClient client = connect();
  client.send(R"({"class":"WATCH","classes":["POSE","EVENT"]})"
              "\n");
  const std::filesystem::path map = folder_ / "map.json";
  std::filesystem::remove(map);
  ASSERT_EQ(::mkfifo(map.c_str(), 0600), 0);
  daemon.send_signal(SIGHUP);
  EXPECT_NE(
      next_event(client, "reload refused")["detail"].get<std::string>().find("no ordinary file"),
      std::string::npos);
  std::filesystem::remove(map);
  write_map(map, "after");
  daemon.send_signal(SIGHUP);
  EXPECT_TRUE(next_event(client, "map loaded").is_object());
  daemon.send_signal(SIGTERM);
  EXPECT_EQ(daemon.wait_for_exit(), 0);
}

TEST_F(Service, TerminateSignalWhileAMapLoads_EndsItBeforeItIsLoaded) {
  const auto expect_end = [](DaemonProcess& daemon) {
    daemon.send_signal(SIGTERM);
    EXPECT_EQ(daemon.wait_for_exit(), 0) << daemon.output();
  };
  {
    DaemonProcess daemon = start();
    TestClient client = connect();
    next_of(client, "POSE");
    write_slow_map(folder_ / "map.json");
    daemon.send_signal(SIGHUP);
    EXPECT_TRUE(test::wait_until([&] { return has_thread(daemon.pid(), "reloader"); }));
    expect_end(daemon);
    EXPECT_EQ(daemon.output().find("map loaded"), std::string::npos) << "it was loading";
  }
  DaemonProcess daemon = start();
  EXPECT_TRUE(test::wait_until(
      [&] { return (signals_in(daemon.pid(), "SigCgt:") & 1U << (SIGTERM - 1)) != 0; }));
  expect_end(daemon);
  EXPECT_EQ(daemon.output(), "") << "it was loading";
}

TEST_F(Service, HangupDuringStart_HandledAfterStart) {
  write_large_map(folder_ / "map.json");
  // Scans of another place that come fast would leave a sanitized reloader no time.
  DaemonProcess daemon = start({"/lidar/speed=0.5"});
  EXPECT_TRUE(test::wait_until([&] { return blocks_hangups(daemon.pid()); }));
  daemon.send_signal(SIGHUP);
  EXPECT_TRUE(test::wait_until([&] {
    return daemon.output().find("map loaded: ") != std::string::npos;
  })) << daemon.output();
}

TEST_F(Service, ManyHangups_OneLine) {
  DaemonProcess daemon = start();
  TestClient client = connect();
  client.send(R"({"class":"WATCH","classes":["EVENT"]})"
              "\n");
  for (int i = 0; i < 5; ++i) {
    daemon.send_signal(SIGHUP);
    ASSERT_TRUE(next_event(client, "map loaded").is_object());
  }
  daemon.send_signal(SIGTERM);
  EXPECT_EQ(daemon.wait_for_exit(), 0);
  const std::string output = daemon.output();
  const std::size_t first = output.find("map loaded: ");
  ASSERT_NE(first, std::string::npos) << output;
  EXPECT_EQ(output.find("map loaded: ", first + 1), std::string::npos) << output;
  EXPECT_EQ(output.find("SIGHUP"), std::string::npos) << output;
}

TEST_F(Service, KilledInstance_NextOneStarts) {
  {
    const DaemonProcess daemon = start();
    connect();
  }
  EXPECT_TRUE(std::filesystem::exists(folder_ / "pose.sock")) << "it was killed";
  const DaemonProcess daemon = start();
  TestClient client = connect();
  EXPECT_EQ(next_of(client, "POSE")["class"], "POSE");
}

}  // namespace
}  // namespace cornerd::system_test
