// SPDX-License-Identifier: MIT
#include "survey/refusals.hpp"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

namespace cornerd::survey {
namespace {

RecordedDrive drive_of(std::size_t scans) {
  RecordedDrive drive;
  for (std::size_t i = 0; i < scans; ++i) {
    core::Scan scan;
    core::Sample sample;
    sample.t_ns = static_cast<core::TimeNs>(i) * 1'000'000'000;
    scan.add(sample);
    drive.add(scan);
  }
  return drive;
}

template <typename Check>
std::string refusal(const Check& check) {
  try {
    check();
  } catch (const std::invalid_argument& refused) {
    return refused.what();
  }
  return {};
}

TEST(RefuseTooFewScans, FewerThanAWallNeeds_SaysHowManyThereWere) {
  EXPECT_EQ(refusal([] { refuse_too_few_scans(drive_of(4), 5); }),
            "whole turns of a lidar in it: 4; a wall has to be seen in 5");
  EXPECT_EQ(refusal([] { refuse_too_few_scans(drive_of(5), 5); }), "");
  EXPECT_EQ(refusal([] { refuse_too_few_scans({}, 5); }), "not one whole turn of a lidar in it");
}

TEST(RefuseWithoutOverlap, MoreThanTwoOfAHundredTurns_SaysWhereTheFirstIs) {
  MappedDrive drive;
  drive.unmatched_scans = {20, 21};
  EXPECT_EQ(refusal([&] { refuse_without_overlap(drive_of(100), drive); }), "");
  drive.unmatched_scans.push_back(22);
  EXPECT_EQ(refusal([&] { refuse_without_overlap(drive_of(100), drive); }),
            "without odometry, 3 of 100 turns see too little of what was seen before them, the "
            "first 20 s after the start; drive more slowly there, or record the odometry too");
  drive.has_odometry = true;
  EXPECT_EQ(refusal([&] { refuse_without_overlap(drive_of(100), drive); }), "");
}

TEST(RefuseUncheckedGuesses, LoopAcrossThem_IsEnough) {
  const std::vector<std::size_t> blind = {40, 41, 42};
  LoopReport loop;
  loop.earlier = 10;
  loop.later = 41;
  const auto with = [&](const LoopReport& report) {
    return refusal([&] { refuse_unchecked_guesses(drive_of(100), blind, {&report, 1}); });
  };
  EXPECT_EQ(with(loop), "");
  loop.refused = "for a reason";
  EXPECT_NE(with(loop).find("3 of 100 turns see walls that tell nothing"), std::string::npos);
  loop.refused.clear();
  loop.later = 40;
  EXPECT_NE(with(loop), "");
}

TEST(RefuseDoubledWalls, MoreThanWhatMoved_SaysHowMuch) {
  const std::vector<core::Wall> small = {{{0, 0}, {10, 0}, 0}};
  const std::vector<core::Wall> large = {{{0, 0}, {100, 0}, 0}};
  EXPECT_EQ(refusal([&] { refuse_doubled_walls(0.49, small); }), "");
  EXPECT_EQ(refusal([&] { refuse_doubled_walls(1.19, large); }), "");
  EXPECT_NE(refusal([&] { refuse_doubled_walls(0.51, small); }).find("0.5 m of walls"),
            std::string::npos);
  EXPECT_NE(refusal([&] { refuse_doubled_walls(1.21, large); }).find("do not overlap enough"),
            std::string::npos);
}

TEST(RefuseSeenThrough, MoreThanADoorThatMoved_SaysWhatShare) {
  const auto with = [](double length_m, std::size_t places, double of_m) {
    return refusal([&] { refuse_seen_through({length_m, places, of_m}); });
  };
  EXPECT_EQ(with(5.9, 2, 100), "");
  EXPECT_NE(with(6.1, 2, 100).find("went through 6.1 of 100.0 m of the walls' sides (6.1 %)"),
            std::string::npos);
  EXPECT_EQ(with(6.1, 1, 100), "");
  EXPECT_EQ(with(0.5, 2, 10), "");
  EXPECT_EQ(with(0, 0, 0), "");
}

TEST(AreWallsSeenThrough, MoreThanNoise_IsSaid) {
  EXPECT_FALSE(are_walls_seen_through({0.3, 1, 100}));
  EXPECT_TRUE(are_walls_seen_through({0.5, 1, 100}));
}

}  // namespace
}  // namespace cornerd::survey
