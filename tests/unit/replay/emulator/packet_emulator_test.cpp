// SPDX-License-Identifier: MIT
// Emulators of packets against the decoders, which share no code with them.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "drivers/make_driver.hpp"
#include "replay/emulator/make_emulator.hpp"
#include "tests/unit/replay/hex.hpp"
#include "tests/unit/replay/test_maps.hpp"

namespace cornerd::replay {
namespace {

constexpr core::TimeNs kStep_ns = 1'000'000;

std::unique_ptr<Scene> room() {
  return std::make_unique<MapScene>(make_room(), stand_still({1, 1, 0}));
}

std::unique_ptr<DeviceEmulator> perfect_emulator(const drivers::LidarModel& model) {
  SimulatorConfig config = simulator_of(model);
  config.sensor.noise = SensorModel::perfect().noise;
  config.sensor.missing = 0;
  config.sensor.outliers = 0;
  return make_emulator(model, room(), config);
}

std::vector<std::uint8_t> run(DeviceEmulator& device, core::TimeNs& now_ns, double seconds) {
  std::vector<std::uint8_t> bytes;
  const core::TimeNs end_ns = now_ns + core::from_seconds(seconds);
  for (; now_ns < end_ns; now_ns += kStep_ns) device.take(now_ns, bytes);
  return bytes;
}

/// The room's range in the direction of each sample, less the measured one.
class RoomCheck : public drivers::FrameSink {
 public:
  void on_sample(const drivers::FrameSample& sample) override {
    ++samples;
    if (sample.starts_scan) ++scans;
    if (sample.range_m <= 0) return;
    const double true_m = room_->range_along(0, 0, core::Vec2::Zero(), -sample.device_rad);
    if (std::abs(true_m - sample.range_m) > 0.003) ++off;
  }
  void on_gap() override { ++gaps; }

  int samples = 0;
  int scans = 0;
  int off = 0;
  int gaps = 0;

 private:
  std::unique_ptr<Scene> room_ = room();
};

class PacketEmulatorTest : public testing::TestWithParam<const char*> {};

TEST_P(PacketEmulatorTest, TwoSeconds_AreDecodedAtTheModelsRate) {
  const drivers::LidarModel& model = *drivers::find_lidar_model(GetParam());
  const auto device = perfect_emulator(model);
  core::TimeNs now_ns = 0;
  const std::vector<std::uint8_t> start = {0xA5, 0x60};
  device->receive(start, now_ns);
  const std::vector<std::uint8_t> bytes = run(*device, now_ns, 2);
  EXPECT_LT(static_cast<double>(bytes.size()), 2 * model.baud / 10.0) << "faster than the wire";

  const auto decoder = drivers::make_decoder(model.driver);
  RoomCheck check;
  decoder->feed(bytes, check);
  EXPECT_NEAR(check.samples, 2 * model.samples_hz, 0.02 * model.samples_hz);
  EXPECT_NEAR(check.scans, 2 * model.rate_hz, 1.5);
  EXPECT_EQ(check.gaps, 0);
  EXPECT_EQ(decoder->counters().skipped_bytes, 0U);
  EXPECT_EQ(decoder->counters().lost_capsules, 0U);
  EXPECT_LT(check.off, check.samples / 100) << "samples that are 3 mm off, but at corners";
  EXPECT_EQ(drivers::detect_driver(std::span(bytes).first(4096)), model.driver);
}

INSTANTIATE_TEST_SUITE_P(Models, PacketEmulatorTest,
                         testing::Values("ld06", "ld19", "stl19p", "stl27l", "x4", "x2"),
                         [](const auto& instance) { return std::string(instance.param); });

TEST(YdlidarEmulator, X4Requests_AreAnswered) {
  const auto device = perfect_emulator(*drivers::find_lidar_model("x4"));
  core::TimeNs now_ns = 0;
  EXPECT_TRUE(run(*device, now_ns, 0.5).empty()) << "silent until it is started";
  const auto ask = [&](const std::string& hex) {
    device->receive(from_hex(hex), now_ns);
    return to_hex(run(*device, now_ns, 0.02));
  };
  const std::string health = to_hex(from_hex("A55A0300000006000000"));
  EXPECT_EQ(ask("A591").substr(0, 20), health);
  EXPECT_EQ(ask("A592").substr(0, 20), health);
  EXPECT_EQ(ask("A590").size(), 2U * 27);
  EXPECT_EQ(ask("A560").substr(0, 14), to_hex(from_hex("A55A0500004081")));
  ask("A565");
  EXPECT_TRUE(run(*device, now_ns, 0.5).empty());
}

}  // namespace
}  // namespace cornerd::replay
