// SPDX-License-Identifier: MIT
#include "daemon/lidar_factory.hpp"

#include <gtest/gtest.h>

#include "drivers/serial/serial_port.hpp"
#include "settings/config.hpp"

namespace cornerd::daemon {
namespace {

TEST(LidarFactory, EveryConfigurableBaud_Supported) {
  for (const std::uint32_t baud : settings::kBaudRates) {
    EXPECT_TRUE(drivers::termios_speed(baud)) << baud;
  }
}

}  // namespace
}  // namespace cornerd::daemon
