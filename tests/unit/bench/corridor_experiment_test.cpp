// SPDX-License-Identifier: MIT
#include "bench/corridor_experiment.hpp"

#include <gtest/gtest.h>

#include <string>

#include "bench/building.hpp"

namespace cornerd::bench {
namespace {

// A subset of 90 rays may not meet a niche: it tells nothing of the place along a corridor.
TEST(Corridor, AnyRobot_NoPlaceThatLooksAlikeIsNamed) {
  for (const CorridorRobot robot : {CorridorRobot::kLidarAlone, CorridorRobot::kWheelsAndGyro}) {
    std::size_t scans = 0;
    std::size_t named = 0;
    for (std::uint64_t seed = 1; seed <= 8; ++seed) {
      const auto corridor = std::make_shared<const core::WallMap>(long_corridor(seed));
      const PoseScore score = drive_along(corridor, robot, 300, seed);
      EXPECT_EQ(score.wrong(), 0U) << "seed " << seed;
      scans += score.scans();
      named += score.named();
    }
    // Some corridors look alike from both ends, until a niche tells them apart.
    EXPECT_GT(named, scans / 2);
    RecordProperty("named", std::to_string(named));
  }
}

}  // namespace
}  // namespace cornerd::bench
