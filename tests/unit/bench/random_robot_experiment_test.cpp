// SPDX-License-Identifier: MIT
#include "bench/random_robot_experiment.hpp"

#include <gtest/gtest.h>

#include <set>

#include "settings/map_file.hpp"

namespace cornerd::bench {
namespace {

TEST(RandomRobotExperiment, DrawnRobots_HaveEveryFaultAndBothKindsOfGyro) {
  std::set<OdometryFault> faults;
  std::set<bool> gyros;
  for (std::uint64_t seed = 1; seed <= 500; ++seed) {
    const RandomRobot robot = draw_robot(seed);
    faults.insert(robot.fault);
    gyros.insert(robot.model.has_gyro);
    EXPECT_EQ(robot.speed_m_s, draw_robot(seed).speed_m_s);
  }
  EXPECT_EQ(faults.size(), static_cast<std::size_t>(OdometryFault::kCount));
  EXPECT_EQ(gyros.size(), 2u);
}

TEST(RandomRobotExperiment, Fault_EndsPredictions) {
  const auto map = settings::load_map(CORNERD_SOURCE_DIR "/config/maps/flat-7.json");
  RandomRobot robot;
  robot.seed = 1;
  const RandomRobotResult healthy = run_random_robot(map, robot);
  EXPECT_GT(healthy.covers, 30u);
  EXPECT_GT(healthy.predicted.poses, 30u);
  EXPECT_EQ(healthy.wrong, 0u);
  EXPECT_EQ(healthy.silent, 0u);
  EXPECT_LT(healthy.predicted.mean(), 5);
  robot.fault = OdometryFault::kLeftReversed;
  const RandomRobotResult faulty = run_random_robot(map, robot);
  EXPECT_LT(faulty.predicted.poses, 3u);
  EXPECT_EQ(faulty.wrong, 0u);
}

}  // namespace
}  // namespace cornerd::bench
