// SPDX-License-Identifier: MIT
#include "bench/blind_experiment.hpp"

#include <gtest/gtest.h>

#include "settings/map_file.hpp"

namespace cornerd::bench {
namespace {

BlindResult run(std::size_t index, std::size_t drives) {
  return run_blind_case(settings::load_map(CORNERD_SOURCE_DIR "/config/maps/flat-7.json"),
                        blind_cases().at(index), 1, drives);
}

TEST(BlindExperiment, CarriedOnPoses_AreHonestBetweenTurnsAndFiveSecondsLater) {
  // The bounds of the issue are 2.5 to 4 and 90 %; three drives are a rough measure.
  for (const BlindAges& ages : run(0, 3)) {
    EXPECT_GT(ages.poses, 2000u);
    EXPECT_GT(ages.mean_nees, 1.8) << ages.from_s;
    EXPECT_LT(ages.mean_nees, 4.2) << ages.from_s;
    EXPECT_GT(ages.share_within, 0.87) << ages.from_s;
    EXPECT_LT(ages.worst_m, 0.01) << ages.from_s;
  }
}

TEST(BlindExperiment, NoisierRobot_SaysSo) {
  for (const BlindAges& ages : run(1, 2)) EXPECT_LT(ages.mean_nees, 4.5) << ages.from_s;
}

TEST(BlindExperiment, SameSeed_GivesTheSameFigures) {
  const BlindResult one = run(4, 1);
  const BlindResult again = run(4, 1);
  for (std::size_t i = 0; i < one.size(); ++i) {
    EXPECT_EQ(one[i].poses, again[i].poses);
    EXPECT_EQ(one[i].mean_nees, again[i].mean_nees);
  }
}

}  // namespace
}  // namespace cornerd::bench
