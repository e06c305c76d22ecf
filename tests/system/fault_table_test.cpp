// SPDX-License-Identifier: MIT
// Faults of a lidar, the reported state, and the time to recover. Prints a table:
//   build/test/tests/system_daemon --gtest_filter='FaultTable.*' | grep '^|'
// With CORNERD_TIMES=1 it also checks the times, on an otherwise idle machine.
#include <gtest/gtest.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>

#include "daemon_process.hpp"
#include "emulated_lidar.hpp"

namespace cornerd::system_test {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point then) {
  return std::chrono::duration<double>(Clock::now() - then).count();
}

class FaultTable : public DaemonTest {
 protected:
  FaultTable() { plug_in(); }

  void plug_in(const replay::EmulatorConfig& config = {}) {
    lidar_.reset();
    lidar_ = std::make_unique<EmulatedLidar>(folder_ / "map.json", folder_ / "lidar", config);
  }

  /// Starts cornerd on the emulated port and waits for the first pose.
  void start_daemon(const std::vector<std::string>& more = {}) {
    launch(more);
    wait_for_fix(*client_);
  }

  void launch(const std::vector<std::string>& more = {}) {
    std::vector<std::string> overrides = {"/lidar/driver=rplidar",
                                          "/lidar/device=" + (folder_ / "lidar").string()};
    overrides.insert(overrides.end(), more.begin(), more.end());
    std::vector<std::string> arguments = with_config();
    for (const std::string& text : overrides) {
      arguments.emplace_back("--set");
      arguments.push_back(text);
    }
    daemon_ = std::make_unique<DaemonProcess>(arguments, folder_ / "log");
    client_ = std::make_unique<TestClient>(connect());
    client_->send(R"({"class":"WATCH","classes":["POSE","EVENT","STATUS"]})"
                  "\n");
  }

  /// Seconds until a STATUS has the fault; `state`: the state of that STATUS.
  double wait_for_fault(const std::string& fault, std::string& state) {
    const auto began = Clock::now();
    const json status = next_of(*client_, "STATUS", [&](const json& message) {
      return message["lidar"].value("fault", "") == fault;
    });
    if (!status.is_object()) return -1;
    state = status["lidar"]["state"];
    EXPECT_FALSE(status["lidar"]["detail"].get<std::string>().empty())
        << "the detail must not be empty";
    return seconds_since(began);
  }

  /// Begins and ends the fault; prints both delays.
  void expect(const char* what, const std::string& fault, const std::string& state,
              const std::function<void()>& begin, const std::function<void()>& end,
              double limit_s = 0, double back_limit_s = 0) {
    begin();
    std::string seen;
    const double noticed_s = wait_for_fault(fault, seen);
    EXPECT_EQ(seen, state) << what;
    end();
    const auto ended = Clock::now();
    skip_stale_poses();
    wait_for_fix(*client_);
    print(what, seen + ", " + fault, noticed_s, seconds_since(ended));
    if (std::getenv("CORNERD_TIMES") == nullptr) return;
    if (limit_s > 0) {
      EXPECT_LT(noticed_s, limit_s) << what;
      EXPECT_LT(seconds_since(ended), back_limit_s) << what;
    }
  }

  /// Poses from before the fault may still arrive until the first STATUS.
  void skip_stale_poses() {
    client_->send("{\"class\":\"POLL\",\"id\":\"now\"}\n");
    next_of(*client_, "OK", [](const json& ok) { return ok.value("id", "") == "now"; });
  }

  static void print(const char* what, const std::string& state, double noticed_s, double back_s) {
    std::printf("| %-44s | %-26s | %6.2f s | %6.2f s |\n", what, state.c_str(), noticed_s, back_s);
    std::fflush(stdout);
  }

  std::unique_ptr<EmulatedLidar> lidar_;
  std::unique_ptr<DaemonProcess> daemon_;
  std::unique_ptr<TestClient> client_;
};

TEST_F(FaultTable, Unplugged_PluggedInAgain_Recovers) {
  start_daemon();
  expect(
      "plug pulled out; put in again", "unplugged", "backoff", [&] { lidar_.reset(); },
      [&] { plug_in(); }, 1, 2);
}

TEST_F(FaultTable, NoPort_PluggedIn_Recovers) {
  lidar_.reset();
  launch();
  expect(
      "no port at the start; plugged in", "no-port", "absent", [] {}, [&] { plug_in(); }, 1, 2);
}

TEST_F(FaultTable, MotorStalled_Released_Recovers) {
  start_daemon();
  expect(
      "head held; let go within 3 s", "motor-stalled", "faulty",
      [&] { lidar_->act([](auto& device, auto t_ns) { device.set_stalled(true, t_ns); }); },
      [&] { lidar_->act([](auto& device, auto t_ns) { device.set_stalled(false, t_ns); }); });
}

TEST_F(FaultTable, HeadStandsWhileItMeasures_TurnsAgain_Recovers) {
  // A packet of the standard mode is a sample, which may come again.
  start_daemon({"/advanced/lidar/mode=Standard"});
  expect(
      "head stands, samples go on; turns again", "no-scan", "faulty",
      [&] { lidar_->act([](auto& device, auto) { device.set_repeating(true); }); },
      [&] { lidar_->act([](auto& device, auto) { device.set_repeating(false); }); });
}

TEST_F(FaultTable, ProtectionStop_Reset_Recovers) {
  start_daemon();
  expect(
      "protection stop; RESET heals it", "protection-stop", "faulty",
      [&] {
        lidar_->act([](auto& device, auto t_ns) {
          device.set_health({.status = 2, .code = 0x8001}, t_ns);
        });
      },
      [] {});
}

TEST_F(FaultTable, HealthError_Healed_Recovers) {
  replay::EmulatorConfig config;
  config.health = {.status = 2, .code = 0x8001};
  config.reset_restores_health = false;
  plug_in(config);
  launch();
  expect(
      "health error that RESET does not heal; healed", "health-error", "faulty", [] {},
      [&] { lidar_->act([](auto& device, auto t_ns) { device.set_health({}, t_ns); }); });
}

TEST_F(FaultTable, DeadLaser_Healed_Recovers) {
  start_daemon();
  expect(
      "nothing returns; sees again", "dead-laser", "faulty", [&] { lidar_->cover(true); },
      [&] { lidar_->cover(false); });
}

TEST_F(FaultTable, WrongBaud_Corrected_Recovers) {
  lidar_->expect_speed(115200);
  launch({"/advanced/lidar/baud=57600"});
  expect(
      "/advanced/lidar/baud is wrong; the device's follows", "wrong-baud", "backoff", [] {},
      [&] { lidar_->expect_speed(57600); });
}

TEST_F(FaultTable, StreamRunning_DaemonRestarted_Recovers) {
  start_daemon();
  const auto began = Clock::now();
  // The old process must have ended before the next starts, as with a service manager.
  daemon_.reset();
  launch();
  wait_for_fix(*client_);
  const double back_s = seconds_since(began);
  // A byte of the old stream between opening the port and STOP is a matter of milliseconds.
  const bool seen = daemon_->output().find("stream-running") != std::string::npos;
  print("killed (SIGKILL) and started again", seen ? "identifying, stream-running" : "identifying",
        0, back_s);
  if (std::getenv("CORNERD_TIMES") != nullptr) {
    EXPECT_LT(back_s, 1.5);
  }
}

TEST_F(FaultTable, SupplyBreakdown_Over_Recovers) {
  start_daemon();
  expect(
      "supply breaks down for a moment", "restarted", "backoff",
      [&] { lidar_->act([](auto& device, auto t_ns) { device.power_cycle(t_ns); }); }, [] {});
}

TEST_F(FaultTable, NoDataAfterStart_MotorTurns_Recovers) {
  lidar_->act([](auto& device, auto t_ns) { device.set_stalled(true, t_ns); });
  launch();
  expect(
      "motor does not start; rotates", "no-data", "backoff", [] {},
      [&] { lidar_->act([](auto& device, auto t_ns) { device.set_stalled(false, t_ns); }); });
}

TEST_F(FaultTable, Booting_Over_Recovers) {
  lidar_.reset();
  launch();
  expect(
      "plugged in, which switches it on", "booting", "identifying",
      [&] {
        plug_in();
        lidar_->act([](auto& device, auto t_ns) { device.power_cycle(t_ns); });
      },
      [] {});
}

}  // namespace
}  // namespace cornerd::system_test
