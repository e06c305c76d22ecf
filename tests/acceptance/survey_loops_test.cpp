// SPDX-License-Identifier: MIT
// Surveys of drives that return: the loop is closed, and no other.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

#include "bench/building.hpp"
#include "bench/survey_experiment.hpp"

namespace cornerd {
namespace {

std::size_t closed_loops(const survey::SurveyResult& result) {
  return static_cast<std::size_t>(
      std::count_if(result.loops.begin(), result.loops.end(),
                    [](const survey::LoopReport& loop) { return loop.closed(); }));
}

class SurveyOfARing : public testing::TestWithParam<std::uint64_t> {
 protected:
  const core::WallMap map_{bench::ring_corridor()};
  const bench::SimulatedDrive drive_ = bench::ring_drive(GetParam());
};

TEST_P(SurveyOfARing, RevisitBeyondMatching_LoopIsClosedWithoutDuplicateWalls) {
  const bench::LoopCase made = bench::survey_loop(map_, drive_, /*close_loops=*/true);
  EXPECT_GE(closed_loops(made.result), 1U);
  EXPECT_GT(made.result.loops.front().off_m, 0.15);
  EXPECT_EQ(made.score.walls_found, made.score.walls_visible);
  EXPECT_GT(made.score.walls_visible, 30U);
  EXPECT_LT(made.score.invented_m, 0.05);
  EXPECT_EQ(made.score.corners_found, made.score.corners_visible);
  EXPECT_LT(made.score.corner_max_m(), 0.02);
}

TEST_P(SurveyOfARing, WithoutLoopClosure_HasDuplicateWalls) {
  const bench::LoopCase made = bench::survey_loop(map_, drive_, /*close_loops=*/false);
  EXPECT_GT(made.score.invented_m, 2);
}

// Drives whose drift is beyond what matching bridges; with half of the seeds it is less.
INSTANTIATE_TEST_SUITE_P(Seeds, SurveyOfARing, testing::Values(3, 4));

/// Nine metres of the ring are degenerate: scans there do not determine the translation along them.
class SurveyOfARingByTheLidarAlone : public testing::TestWithParam<std::uint64_t> {
 protected:
  const bench::SimulatedDrive drive_ = bench::ring_drive(GetParam(), /*has_odometry=*/false);
};

TEST_P(SurveyOfARingByTheLidarAlone, DegeneratePartInsideLoop_MapIsRightAndReported) {
  const bench::LoopCase made =
      bench::survey_loop(core::WallMap(bench::ring_corridor()), drive_, /*close_loops=*/true);
  EXPECT_EQ(made.score.walls_found, made.score.walls_visible);
  EXPECT_LT(made.score.invented_m, 0.05);
  EXPECT_GT(made.result.degenerate_scans.size(), 100U);
}

TEST(SurveyOfARingByTheLidarAloneLeftOpen, DegeneratePart_IsRejected) {
  const bench::SimulatedDrive drive = bench::ring_drive(1, /*has_odometry=*/false);
  survey::SurveyConfig config;
  config.close_loops = false;
  try {
    survey::survey(drive.drive, config);
    FAIL() << "a map";
  } catch (const std::invalid_argument& refused) {
    EXPECT_THAT(refused.what(), testing::HasSubstr("show only walls along one direction"));
  }
}

// Seeds 2, 11 and 12 fail where scans are deskewed only once and by the previous motion.
INSTANTIATE_TEST_SUITE_P(Seeds, SurveyOfARingByTheLidarAlone, testing::Values(1, 2, 3, 11, 12));

class SurveyOfEqualRooms : public testing::TestWithParam<std::uint64_t> {};

TEST_P(SurveyOfEqualRooms, LookAlikeRooms_AreNotClosed) {
  constexpr double kDrift_m = 0.5;  // the rooms are 3.5 m apart
  const core::WallMap map(bench::equal_rooms(4));
  const bench::LoopCase made =
      bench::survey_loop(map, bench::equal_rooms_drive(GetParam()), /*close_loops=*/true);
  std::size_t look_alike = 0;
  for (const survey::LoopReport& loop : made.result.loops) {
    if (loop.off_m < kDrift_m) continue;
    ++look_alike;
    EXPECT_FALSE(loop.closed());
  }
  EXPECT_GE(look_alike, 1U);
  EXPECT_LT(made.score.invented_m, 0.05);
}

INSTANTIATE_TEST_SUITE_P(Seeds, SurveyOfEqualRooms, testing::Values(1, 2, 3, 5, 6, 7));

}  // namespace
}  // namespace cornerd
