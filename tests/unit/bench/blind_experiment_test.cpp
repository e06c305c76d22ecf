// SPDX-License-Identifier: MIT
#include "bench/blind_experiment.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>
#include <string>
#include <string_view>

#include "settings/map_file.hpp"

namespace cornerd::bench {
namespace {

BlindResult run(std::string_view title, std::size_t drives) {
  const auto cases = blind_cases();
  const auto blind = std::find_if(cases.begin(), cases.end(),
                                  [&](const BlindCase& one) { return one.title == title; });
  if (blind == cases.end()) throw std::invalid_argument(std::string(title));
  return run_blind_case(settings::load_map(CORNERD_SOURCE_DIR "/config/maps/flat-7.json"), *blind,
                        1, drives);
}

TEST(BlindExperiment, CarriedOnPoses_AreHonestBetweenTurnsAndFiveSecondsLater) {
  // 3 is exact, and 95 %; three drives are a rough measure.
  for (const BlindAges& ages : run("16 cm robot", 3)) {
    EXPECT_GT(ages.poses, 2000u);
    EXPECT_GT(ages.mean_nees, 1.4) << ages.from_s;
    EXPECT_LT(ages.mean_nees, 4) << ages.from_s;
    EXPECT_GT(ages.share_within, 0.9) << ages.from_s;
    EXPECT_LT(ages.worst_m, 0.01) << ages.from_s;
  }
}

TEST(BlindExperiment, NoisierRobot_SaysSo) {
  for (const BlindAges& ages : run("twice the noise", 2)) {
    EXPECT_LT(ages.mean_nees, 4) << ages.from_s;
  }
}

TEST(BlindExperiment, CoarseCounts_CostNoMoreThanACountAndAreToldHonestly) {
  for (const BlindAges& ages : run("counts of 5 mm", 2)) {
    EXPECT_GT(ages.mean_nees, 1.4) << ages.from_s;
    EXPECT_LT(ages.mean_nees, 4) << ages.from_s;
    EXPECT_LT(ages.mean_m, 0.003) << ages.from_s;
  }
}

TEST(BlindExperiment, LidarThatIsOff_IsLearntOnTheWay) {
  for (const BlindAges& ages : run("a lidar off by 5 mm and 0.5 %", 1)) {
    EXPECT_GT(ages.mean_nees, 1) << ages.from_s;
    EXPECT_LT(ages.mean_nees, 4) << ages.from_s;
    EXPECT_LT(ages.mean_m, 0.002) << ages.from_s;
  }
}

TEST(BlindExperiment, RobotsAsWrongAsTold_AreHonestBeforeMuchIsLearned) {
  // The fixes' own doubt, which has yet to be learned, makes them cautious at first.
  const BlindResult result = run("after 3 s, robots drawn", 4);
  for (const BlindAges& ages : result) EXPECT_LT(ages.mean_nees, 4) << ages.from_s;
  for (std::size_t i = 1; i < result.size(); ++i) {
    EXPECT_GT(result[i].mean_nees, 1.2) << result[i].from_s;
    EXPECT_GT(result[i].share_within, 0.88) << result[i].from_s;
  }
}

TEST(BlindExperiment, SameSeed_GivesTheSameFigures) {
  const BlindResult one = run("after 3 s, robots drawn", 1);
  const BlindResult again = run("after 3 s, robots drawn", 1);
  for (std::size_t i = 0; i < one.size(); ++i) {
    EXPECT_EQ(one[i].poses, again[i].poses);
    EXPECT_EQ(one[i].mean_nees, again[i].mean_nees);
  }
}

}  // namespace
}  // namespace cornerd::bench
