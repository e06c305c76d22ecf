// SPDX-License-Identifier: MIT
#include "daemon/reloader.hpp"

#include <gtest/gtest.h>

namespace cornerd::daemon {
namespace {

TEST(NeedsRestart, SensorsOfTheBoard_AreNamed) {
  const settings::Config before;
  settings::Config now;
  EXPECT_EQ(needs_restart(before, now), "");
  now.odometry.kernel.left.reversed = true;
  now.odometry.kernel.right.count = 1;
  now.odometry.kernel.gyro.axis = 'x';
  now.odometry.kernel.rate_hz = 100;
  EXPECT_EQ(needs_restart(before, now),
            "/odometry/kernel/left/reversed, /odometry/kernel/right/count, "
            "/odometry/kernel/gyro/axis, /odometry/kernel/rate");
}

TEST(NeedsRestart, WhatAReloadTakes_IsNotNamed) {
  const settings::Config before;
  settings::Config now;
  now.map = "/another.json";
  now.odometry.core.publish_predictions = true;
  now.odometry.core.max_extrapolation_s = 3;
  EXPECT_EQ(needs_restart(before, now), "");
}

}  // namespace
}  // namespace cornerd::daemon
