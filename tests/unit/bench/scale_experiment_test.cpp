// SPDX-License-Identifier: MIT
#include "bench/scale_experiment.hpp"

#include <gtest/gtest.h>

namespace cornerd::bench {
namespace {

TEST(ScaleExperiment, HundredRooms_EachScanIsFixed) {
  const auto cases = scale_cases({1200}, 1);
  ASSERT_EQ(cases.size(), 2U);
  const ScaleResult result = run_scale_case(cases[0], 40, 1);
  EXPECT_EQ(result.score.scans(), 40U);
  EXPECT_EQ(
      result.score.right() + result.score.wrong() + result.score.ambiguous() + result.score.lost(),
      40U);
  EXPECT_GE(result.score.right(), 38U);
  EXPECT_EQ(result.score.wrong(), 0U);
  EXPECT_LT(result.score.mean_error_m(), 0.002);
  EXPECT_GT(result.pairs, 1000U);
  EXPECT_GT(result.memory_bytes, 100'000U);
  EXPECT_GT(result.time_99_us, 0);
}

/// One of these scans shows a bare corridor that resembles another one with two obstacles.
TEST(ScaleExperiment, BareCorridor_NoFix) {
  const ScaleResult result = run_scale_case(scale_cases({2000}, 1)[0], 10, 1);
  EXPECT_EQ(result.score.wrong(), 0U);
  EXPECT_GE(result.score.right(), 8U);
}

TEST(ScaleExperiment, EqualRooms_AmbiguousWithTruth) {
  const auto cases = scale_cases({}, 1);
  const ScaleResult result = run_scale_case(cases[0], 60, 2);
  EXPECT_EQ(result.score.wrong(), 0U);
  EXPECT_GT(result.score.ambiguous(), 30U);
  EXPECT_EQ(result.score.ambiguous_with_truth(), result.score.ambiguous());
}

TEST(ScaleExperiment, TwentyThousandCorners_MemoryBelow64MiB) {
  const auto cases = scale_cases({20'000}, 1);
  const ScaleResult result = run_scale_case(cases[0], 10, 1);
  EXPECT_GT(result.corners, 18'000U);
  EXPECT_LT(result.memory_bytes, std::size_t{64} << 20);
  EXPECT_EQ(result.score.wrong(), 0U);
  EXPECT_GE(result.score.right(), 9U);
}

}  // namespace
}  // namespace cornerd::bench
