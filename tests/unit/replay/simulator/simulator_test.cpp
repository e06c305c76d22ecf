// SPDX-License-Identifier: MIT
#include "replay/simulator/simulator.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/unit/replay/test_maps.hpp"

namespace cornerd::replay {
namespace {

const core::Pose2 kPose{0.7, 1.1, 0.4};

SimulatorConfig config_for(rplidar::WireFormat wire) {
  SimulatorConfig config;
  config.wire = wire;
  config.sensor = SensorModel::perfect();
  return config;
}

std::unique_ptr<Scene> standing_scene() {
  return std::make_unique<MapScene>(make_room(), stand_still(kPose));
}

double true_range_m(double device_angle_deg, bool inverted = false) {
  static const auto kRoom = make_room();
  const double bearing_rad = core::radians(inverted ? device_angle_deg : -device_angle_deg);
  return kRoom->range_along(kPose.translation(), kPose.theta_rad + bearing_rad, 100);
}

class SimulatorOfEveryFormat : public ::testing::TestWithParam<rplidar::WireFormat> {};
INSTANTIATE_TEST_SUITE_P(Formats, SimulatorOfEveryFormat,
                         ::testing::Values(rplidar::WireFormat::kStandard,
                                           rplidar::WireFormat::kExpress,
                                           rplidar::WireFormat::kUltra));

TEST_P(SimulatorOfEveryFormat, PerfectSensor_HasTheRangeInTheWiresDirection) {
  Simulator simulator(standing_scene(), config_for(GetParam()));
  // Half a step of the distance's code; ultra truncates, and its direction depends on the distance.
  const double tolerance_m = GetParam() == rplidar::WireFormat::kStandard  ? 0.000126
                             : GetParam() == rplidar::WireFormat::kExpress ? 0.000501
                                                                           : 0.0085;
  std::size_t count = 0;
  while (count < 5000) {
    for (const SimulatedSample& sample : simulator.next().samples) {
      ++count;
      ASSERT_GT(sample.dist_q2, 0u);
      ASSERT_NEAR(sample.dist_q2 / 4000.0, true_range_m(sample.device_angle_deg), tolerance_m)
          << sample.device_angle_deg;
    }
  }
}

TEST_P(SimulatorOfEveryFormat, FieldOfView_HasAllReturnsInside) {
  SimulatorConfig config = config_for(GetParam());
  constexpr double kCentre_rad = core::radians(40);
  config.sensor.field_of_view = {core::radians(120), kCentre_rad};
  for (const double outliers : {0.0, 0.2}) {
    for (const bool inverted : {false, true}) {
      config.sensor.outliers = outliers;
      config.inverted = inverted;
      Simulator simulator(standing_scene(), config);
      for (int packets = 0; packets < 2000; ++packets) {
        for (const SimulatedSample& sample : simulator.next().samples) {
          const double bearing_rad = to_sample(sample, inverted).bearing_rad;
          const double aside_deg =
              std::abs(core::degrees(core::angle_between(kCentre_rad, bearing_rad)));
          // Ultra capsules round the distance on which the direction depends, and drop outliers.
          // Samples without a return have uncorrected angles: up to 8 degrees farther.
          ASSERT_TRUE(sample.dist_q2 == 0 || aside_deg < 60.5) << aside_deg;
          ASSERT_TRUE(sample.dist_q2 != 0 || aside_deg > 51.5 || outliers > 0) << aside_deg;
        }
      }
    }
  }
}

TEST_P(SimulatorOfEveryFormat, Scans_StartAtTheLastSampleBeforeZero) {
  Simulator simulator(standing_scene(), config_for(GetParam()));
  std::int64_t scan = -1;
  core::TimeNs last_start_ns = 0;
  while (scan < 20) {
    for (const SimulatedSample& sample : simulator.next().samples) {
      ASSERT_EQ(sample.scan, sample.starts_scan ? scan + 1 : scan);
      if (!sample.starts_scan) continue;
      scan = sample.scan;
      EXPECT_GT(sample.device_angle_deg, 351);
      if (scan > 0) {
        const double period_s = core::to_seconds(sample.t_ns - last_start_ns);
        EXPECT_NEAR(period_s, 1 / 7.3, 3 * 0.007 / 7.3 + 0.001);
      }
      last_start_ns = sample.t_ns;
    }
  }
}

TEST_P(SimulatorOfEveryFormat, SampleTimes_AreOnePeriodApartAcrossPackets) {
  Simulator simulator(standing_scene(), config_for(GetParam()));
  core::TimeNs expected_ns = 0;
  for (int i = 0; i < 50; ++i) {
    const WirePacket packet = simulator.next();
    for (const SimulatedSample& sample : packet.samples) {
      EXPECT_EQ(sample.t_ns, expected_ns);
      expected_ns += nominal_sample_period_ns(GetParam());
    }
    EXPECT_GE(packet.ready_ns, expected_ns);
  }
}

TEST_P(SimulatorOfEveryFormat, SameSeed_GivesTheSameBytes) {
  SimulatorConfig config = config_for(GetParam());
  config.sensor = SensorModel{};
  const auto bytes_with_seed = [&](std::uint64_t seed) {
    config.seed = seed;
    Simulator simulator(standing_scene(), config);
    std::vector<std::uint8_t> bytes;
    while (bytes.size() < 4000) {
      const WirePacket packet = simulator.next();
      bytes.insert(bytes.end(), packet.bytes.begin(), packet.bytes.end());
    }
    return bytes;
  };
  EXPECT_EQ(bytes_with_seed(7), bytes_with_seed(7));
  EXPECT_NE(bytes_with_seed(7), bytes_with_seed(8));
}

TEST(Simulator, ExpressNoise_HasTheModelsSigma) {
  SimulatorConfig config = config_for(rplidar::WireFormat::kExpress);
  config.sensor.noise.floor_m = 0.004;
  Simulator simulator(standing_scene(), config);
  double sum_of_squares = 0;
  int count = 0;
  while (count < 20000) {
    for (const SimulatedSample& sample : simulator.next().samples) {
      const double error_m = sample.dist_q2 / 4000.0 - true_range_m(sample.device_angle_deg);
      sum_of_squares += error_m * error_m;
      ++count;
    }
  }
  EXPECT_NEAR(std::sqrt(sum_of_squares / count), 0.004, 0.0002);
}

TEST(Simulator, StandardNodes_StepBackByTheConfiguredShare) {
  SimulatorConfig config = config_for(rplidar::WireFormat::kStandard);
  config.sensor.backward = 0.03;
  Simulator simulator(standing_scene(), config);
  constexpr int kCount = 50'000;
  int steps_back = 0;
  double last_deg = 0;
  for (int i = 0; i < kCount; ++i) {
    const SimulatedSample sample = simulator.next().samples[0];
    steps_back +=
        core::angle_between(core::radians(last_deg), core::radians(sample.device_angle_deg)) < 0;
    last_deg = sample.device_angle_deg;
    ASSERT_NEAR(sample.dist_q2 / 4000.0, true_range_m(sample.device_angle_deg), 0.000126);
    if (sample.starts_scan) {
      ASSERT_GT(sample.device_angle_deg, 351);
    }
  }
  EXPECT_NEAR(static_cast<double>(steps_back) / kCount, 0.03, 0.003);
}

/// Real A1s lose a third of their samples in runs, and 2 to 5 % of their nodes step back.
TEST(Simulator, MissingRuns_StepBackAsOnRealDevices) {
  SimulatorConfig config = config_for(rplidar::WireFormat::kStandard);
  config.sensor.missing = 0.38;
  config.sensor.missing_run = 6;
  Simulator simulator(standing_scene(), config);
  constexpr int kCount = 20'000;
  int steps_back = 0;
  double last_deg = 0;
  for (int i = 0; i < kCount; ++i) {
    const SimulatedSample sample = simulator.next().samples[0];
    steps_back +=
        core::angle_between(core::radians(last_deg), core::radians(sample.device_angle_deg)) < 0;
    last_deg = sample.device_angle_deg;
  }
  EXPECT_GT(steps_back, 0.02 * kCount);
  EXPECT_LT(steps_back, 0.05 * kCount);
}

TEST(Simulator, WideBeam_IsSymmetric) {
  for (const auto wire : {rplidar::WireFormat::kStandard, rplidar::WireFormat::kUltra}) {
    SimulatorConfig config = config_for(wire);
    config.sensor.beam_width_rad = core::radians(1);
    Simulator simulator(standing_scene(), config);
    double sum_m = 0;
    int count = 0;
    while (count < 3000) {
      for (const SimulatedSample& sample : simulator.next().samples) {
        const double deg = sample.device_angle_deg;
        const double range_m = true_range_m(deg);
        const double slope_m = true_range_m(deg + 0.1) - true_range_m(deg - 0.1);
        // An asymmetric beam would be biased where the range grows to one side.
        sum_m += (slope_m > 0 ? 1 : -1) * (sample.dist_q2 / 4000.0 - range_m);
        ++count;
      }
    }
    EXPECT_NEAR(sum_m / count, 0, 0.0004);
  }
}

TEST(Simulator, Inverted_CountsCounterClockwise) {
  SimulatorConfig config = config_for(rplidar::WireFormat::kStandard);
  config.inverted = true;
  Simulator simulator(standing_scene(), config);
  for (int i = 0; i < 1000; ++i) {
    const SimulatedSample sample = simulator.next().samples[0];
    ASSERT_NEAR(sample.dist_q2 / 4000.0, true_range_m(sample.device_angle_deg, true), 0.000126);
  }
}

TEST(Simulator, Start_BeginsTheNewFormatWithTheRestartFlag) {
  Simulator simulator(standing_scene(), config_for(rplidar::WireFormat::kStandard));
  for (int i = 0; i < 100; ++i) simulator.next();
  simulator.start(core::kNsPerSecond, rplidar::WireFormat::kUltra, 201'000);
  WirePacket packet = simulator.next();
  EXPECT_EQ(packet.bytes.size(), 132u);
  EXPECT_EQ(packet.bytes[3] & 0x80, 0x80);
  EXPECT_EQ(packet.samples[0].t_ns, core::kNsPerSecond);
  EXPECT_EQ(packet.samples[1].t_ns, core::kNsPerSecond + 201'000);
  packet = simulator.next();
  EXPECT_EQ(packet.bytes[3] & 0x80, 0);
}

TEST(Simulator, MotorRateOutOfRange_IsRefused) {
  SimulatorConfig config;
  config.motor_hz = 0;
  EXPECT_THROW(Simulator(standing_scene(), config), std::invalid_argument);
  config.motor_hz = std::nan("");
  EXPECT_THROW(Simulator(standing_scene(), config), std::invalid_argument);
}

}  // namespace
}  // namespace cornerd::replay
