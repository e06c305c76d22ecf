// SPDX-License-Identifier: MIT
#include "bench/corridor_experiment.hpp"

#include <gtest/gtest.h>

#include "bench/building.hpp"

namespace cornerd::bench {
namespace {

// In 22 of these 24 drives a place that looks alike was named, by up to the corridor's length off.
TEST(Corridor, AnyRobot_NoPlaceThatLooksAlikeIsNamed) {
  for (const CorridorRobot robot : {CorridorRobot::kLidarAlone, CorridorRobot::kWheelsAndGyro}) {
    for (std::uint64_t seed = 1; seed <= 12; ++seed) {
      const auto corridor = std::make_shared<const core::WallMap>(long_corridor(seed));
      const PoseScore score = drive_along(corridor, robot, 300, seed);
      EXPECT_EQ(score.wrong(), 0U) << "seed " << seed;
      EXPECT_GT(score.named(), score.scans() / 2) << "seed " << seed;
    }
  }
}

}  // namespace
}  // namespace cornerd::bench
