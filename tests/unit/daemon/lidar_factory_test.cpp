// SPDX-License-Identifier: MIT
#include "daemon/lidar_factory.hpp"

#include <gtest/gtest.h>

#include <string>

#include "settings/config.hpp"

namespace cornerd::daemon {
namespace {

TEST(LidarFactory, EveryDriver_IsMadeAndHasNoise) {
  for (const char* driver : {"rplidar", "ld", "ydlidar"}) {
    const settings::Config config = settings::parse_config(
        R"({"map": "/m"})", "c.json", {std::string("/lidar/driver=") + driver});
    EXPECT_NE(make_lidar(config.lidar), nullptr) << driver;
    EXPECT_GT(config.lidar.noise.sensor.floor_m, 0) << driver;
  }
}

}  // namespace
}  // namespace cornerd::daemon
