// SPDX-License-Identifier: MIT
// Runs the driver against a scripted A1 and collects samples, states, faults and hints.
#pragma once

#include <gmock/gmock.h>

#include <chrono>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "drivers/rplidar/rplidar_driver.hpp"
#include "scripted_a1.hpp"

namespace cornerd::rplidar::test {

class Samples : public drivers::SampleSink {
 public:
  void on_sample(const core::Sample& sample) override { all.push_back(sample); }
  void on_gap() override { ++gaps; }
  std::vector<core::Sample> all;
  int gaps = 0;
};

class RplidarDriverTest : public testing::Test {
 public:
  /// Runs the driver until `duration` has passed on the clock.
  void run(std::chrono::milliseconds duration) {
    std::stop_source stop;
    const core::TimeNs end_ns = clock.now_ns + std::chrono::nanoseconds(duration).count();
    clock.on_advance = [&, end_ns] {
      if (event && clock.now_ns >= event_ns) std::exchange(event, nullptr)();
      drivers::LidarChange change;
      while (driver->take_change(change)) {
        if (states.empty() || states.back() != change.state) states.push_back(change.state);
        if (change.fault != drivers::LidarFault::kNone) faults.push_back(change.fault);
        hints[change.fault] = change.detail.view();
      }
      last = driver->status();
      const auto& counters = last.counters;
      EXPECT_LE(counters.used_bytes + counters.skipped_bytes, counters.bytes);
      if (clock.now_ns >= end_ns) stop.request_stop();
    };
    driver->run(stop.get_token(), samples);
    clock.on_advance = nullptr;
  }

  /// Calls `happens` after `duration`.
  void after(std::chrono::milliseconds duration, std::function<void()> happens) {
    event_ns = clock.now_ns + std::chrono::nanoseconds(duration).count();
    event = std::move(happens);
  }

  void make(const std::string& mode = "auto", std::vector<std::uint32_t> rates = {115200}) {
    driver.emplace(
        RplidarDriverConfig{
            .device = "/dev/lidar", .baud_rates = std::move(rates), .mode = mode, .motor = {}},
        [this](std::uint32_t at_baud) { return a1.open(at_baud); }, clock);
  }

  void SetUp() override { make(); }

  ManualClock clock;
  ScriptedA1 a1{clock};
  Samples samples;
  std::optional<RplidarDriver> driver;
  core::TimeNs event_ns = 0;
  std::function<void()> event;
  std::vector<drivers::LidarState> states;
  std::vector<drivers::LidarFault> faults;
  std::map<drivers::LidarFault, std::string> hints;
  drivers::LidarStatus last;
};

}  // namespace cornerd::rplidar::test
