// SPDX-License-Identifier: MIT
#include "replay/simulator/scan_simulator.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "tests/unit/replay/test_maps.hpp"

namespace cornerd::replay {
namespace {

using core::Sample;

TEST(ScanSimulator, PerfectSensor_ReturnsWallsAtEvenSteps) {
  const auto map = make_room();
  ScanSimulator simulator(SensorModel::perfect(), 360, 1);
  const core::Pose2 place{1.2, 1.1, 0.4};
  const core::Scan& scan = simulator.take(*map, place);
  ASSERT_EQ(scan.size(), 360u);
  EXPECT_TRUE(scan.samples().front().starts_scan);
  for (std::size_t i = 0; i < scan.size(); ++i) {
    const Sample& sample = scan.samples()[i];
    EXPECT_NEAR(sample.bearing_rad, core::kPi - core::radians(1) * (static_cast<double>(i) + 0.5),
                1e-6);
    EXPECT_NEAR(sample.range_m,
                map->range_along(place.translation(), place.theta_rad + sample.bearing_rad, 12),
                1e-5);
  }
}

TEST(ScanSimulator, MissingReturns_HaveTheModelsShare) {
  const auto map = make_room();
  SensorModel sensor;
  sensor.missing = 1.0 / 3;
  ScanSimulator simulator(sensor, 8000, 1);
  const auto samples = simulator.take(*map, {1, 1, 0}).samples();
  const auto missing = std::count_if(samples.begin(), samples.end(),
                                     [](const Sample& sample) { return sample.range_m == 0; });
  EXPECT_NEAR(static_cast<double>(missing), 8000.0 / 3, 150);
}

TEST(ScanSimulator, SuccessiveScans_DifferReproducibly) {
  const auto map = make_room();
  const auto ranges = [&](ScanSimulator& simulator) {
    std::vector<float> result;
    for (const Sample& sample : simulator.take(*map, {1, 1, 0}).samples()) {
      result.push_back(sample.range_m);
    }
    return result;
  };
  ScanSimulator one({}, 100, 5);
  ScanSimulator same({}, 100, 5);
  const auto first = ranges(one);
  EXPECT_EQ(first, ranges(same));
  EXPECT_NE(first, ranges(one));
}

TEST(ScanSimulator, FieldOfView_HasNoReturnsOutside) {
  SensorModel sensor = SensorModel::perfect();
  sensor.field_of_view = {core::radians(90), 0};
  ScanSimulator lidar(sensor, 360, 1);
  for (const core::Sample& sample : lidar.take(*make_room(), {1, 1, 0}).samples()) {
    EXPECT_EQ(sample.range_m > 0, std::abs(sample.bearing_rad) <= core::kPi / 4);
  }
}

}  // namespace
}  // namespace cornerd::replay
