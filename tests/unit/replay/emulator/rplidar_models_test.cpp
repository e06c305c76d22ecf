// SPDX-License-Identifier: MIT
// Every RPLidar of the table, in every mode that it offers: its emulator against the driver, which
// share the framing of requests and nothing of the packets.
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <string>
#include <tuple>
#include <vector>

#include "drivers/make_driver.hpp"
#include "drivers/rplidar/rplidar_driver.hpp"
#include "replay/emulator/emulated_device.hpp"
#include "replay/emulator/make_emulator.hpp"
#include "tests/unit/replay/test_maps.hpp"

namespace cornerd::replay {
namespace {

std::unique_ptr<Scene> family_room() {
  return std::make_unique<MapScene>(make_room(), stand_still({1, 1, 0}));
}

/// Nothing is heard at another speed.
class DeafStream : public drivers::ByteStream {
 public:
  explicit DeafStream(VirtualClock& clock) : clock_(clock) {}
  ReadResult read(std::span<std::uint8_t>, std::chrono::milliseconds timeout) override {
    clock_.wait(timeout, {});
    return {};
  }
  bool write(std::span<const std::uint8_t>) override { return true; }
  void discard_input() override {}
  bool set_dtr(bool) override { return true; }

 private:
  VirtualClock& clock_;
};

/// Checks each range against the room.
class FamilyRoomSink : public drivers::SampleSink {
 public:
  void on_sample(const core::Sample& sample) override {
    ++samples;
    if (sample.starts_scan) ++scans;
    if (sample.range_m <= 0) return;
    const double true_m =
        room_->range_along(0, 0, core::Vec2::Zero(), static_cast<double>(sample.bearing_rad));
    // An ultra capsule rounds to 4 mm below 4 m.
    if (std::abs(true_m - sample.range_m) > 0.006) ++off;
  }
  void on_gap() override { ++gaps; }

  int samples = 0;
  int scans = 0;
  int off = 0;
  int gaps = 0;

 private:
  std::unique_ptr<Scene> room_ = family_room();
};

struct Measured {
  drivers::LidarStatus status;
  std::vector<drivers::LidarFault> faults;
  FamilyRoomSink sink;
};

/// Three seconds of measuring.
void measure(const drivers::LidarModel& model, const std::string& mode, Measured& result) {
  SimulatorConfig config = simulator_of(model);
  config.sensor = SensorModel::perfect();
  config.sensor.max_range_m = model.max_range_m;
  VirtualClock clock;
  EmulatorConfig device;
  device.baud = model.baud;
  const auto emulator = make_emulator(model, family_room(), config);
  EmulatedDevice port(std::move(dynamic_cast<Emulator&>(*emulator)), clock, 1);
  const auto open = [&](std::uint32_t baud) {
    if (baud == model.baud) return port.open();
    return drivers::OpenResult{std::make_unique<DeafStream>(clock), drivers::OpenError::kNone, {}};
  };
  const auto driver = [&] {
    rplidar::RplidarDriverConfig wanted;
    wanted.baud_rates = drivers::baud_rates_of(drivers::DriverKind::kRplidar);
    wanted.mode = mode;
    return std::make_unique<rplidar::RplidarDriver>(wanted, open, clock);
  }();
  std::stop_source stop;
  core::TimeNs running_ns = 0;
  clock.set_on_advance([&](core::TimeNs now_ns) {
    drivers::LidarChange change;
    while (driver->take_change(change)) {
      if (change.fault != drivers::LidarFault::kNone) result.faults.push_back(change.fault);
      if (change.state == drivers::LidarState::kRunning) running_ns = now_ns;
    }
    if (!stop.stop_requested()) result.status = driver->status();
    const bool is_over = running_ns != 0 && now_ns > running_ns + 3 * core::kNsPerSecond;
    if (is_over || now_ns > 20 * core::kNsPerSecond) stop.request_stop();
  });
  driver->run(stop.get_token(), result.sink);
}

using ModelAndMode = std::tuple<const char*, const char*, double>;

class RplidarModels : public testing::TestWithParam<ModelAndMode> {};

TEST_P(RplidarModels, Mode_IsFoundAndDecodedWithoutALoss) {
  const auto& [name, mode, samples_hz] = GetParam();
  const drivers::LidarModel& model = *drivers::find_lidar_model(name);
  Measured result;
  measure(model, mode, result);
  EXPECT_TRUE(result.faults.empty()) << drivers::to_string(result.faults.front());
  EXPECT_EQ(result.status.known_model, &model);
  std::string shown = result.status.model.view().substr(0, 2).data();
  shown.resize(2);
  std::transform(shown.begin(), shown.end(), shown.begin(), ::tolower);
  EXPECT_EQ(std::string(name).substr(0, 2), shown);
  if (std::string(mode) != "auto") {
    EXPECT_EQ(result.status.mode.view(), mode);
  }
  EXPECT_NEAR(result.status.samples_hz, samples_hz, 0.01 * samples_hz);
  EXPECT_NEAR(result.status.rate_hz, model.rate_hz, 0.3);
  EXPECT_EQ(result.sink.gaps, 1) << "at the end";
  EXPECT_LT(result.sink.off, result.sink.samples / 100) << "but at corners";
  const auto& counters = result.status.counters;
  EXPECT_EQ(counters.bad_checksums + counters.bad_nodes + counters.resyncs + counters.lost_capsules,
            0U);
  EXPECT_EQ(counters.clock_resets, 0U);
}

INSTANTIATE_TEST_SUITE_P(
    Modes, RplidarModels,
    testing::Values(ModelAndMode{"a1", "auto", 3937}, ModelAndMode{"a2m8", "auto", 3968},
                    ModelAndMode{"a2m8", "Standard", 1984}, ModelAndMode{"a2m8", "Boost", 7937},
                    ModelAndMode{"a2m12", "auto", 7937}, ModelAndMode{"a2m12", "Boost", 15873},
                    ModelAndMode{"a3", "auto", 7937}, ModelAndMode{"a3", "Standard", 3968},
                    ModelAndMode{"a3", "Sensitivity", 15873},
                    ModelAndMode{"a3", "Stability", 10000}, ModelAndMode{"c1", "auto", 5000},
                    ModelAndMode{"c1", "Standard", 5000}, ModelAndMode{"s1", "auto", 9259},
                    ModelAndMode{"s1", "Standard", 4098}, ModelAndMode{"s2", "auto", 32000},
                    ModelAndMode{"s2", "Standard", 16000}, ModelAndMode{"s3", "auto", 32000},
                    ModelAndMode{"s3", "Standard", 16000}, ModelAndMode{"s3", "UltraDense", 32000},
                    ModelAndMode{"s3", "HQ", 10000}),
    [](const auto& instance) {
      return std::string(std::get<0>(instance.param)) + "_" + std::get<1>(instance.param);
    });

}  // namespace
}  // namespace cornerd::replay
