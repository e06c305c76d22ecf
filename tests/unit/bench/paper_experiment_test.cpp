// SPDX-License-Identifier: MIT
#include "bench/paper_experiment.hpp"

#include <gtest/gtest.h>

#include <array>
#include <numeric>

#include "tests/unit/bench/contest_maps.hpp"

namespace cornerd::bench {
namespace {

TEST(PaperFigures, Sums_MatchTheText) {
  // Section V.E and the abstract: 2, 10 and 23 errors at 43 poses; section V.D: the mean times.
  std::array<std::size_t, kPaperMethodCount> errors{};
  std::array<double, kPaperMethodCount> times_ms{};
  std::size_t poses = 0;
  for (const PaperLocation& location : kPaperLocations) {
    poses += location.poses;
    for (std::size_t m = 0; m < kPaperMethodCount; ++m) {
      errors[m] += location.cells[m].false_corners;
      times_ms[m] += location.cells[m].time_ms * static_cast<double>(location.poses);
    }
  }
  EXPECT_EQ(poses, 43u);
  EXPECT_EQ(errors, (std::array<std::size_t, 3>{2, 10, 23}));
  for (std::size_t m = 0; m < kPaperMethodCount; ++m) {
    EXPECT_NEAR(times_ms[m] / 43, kPaperTimes_ms[m].mean, 0.01 * kPaperTimes_ms[m].mean);
  }
}

TEST(PaperExperiment, EachMethodAndPose_HasResults) {
  const auto scans = simulate_paper_scans(contest_maps(), {}, 800, 1);
  ASSERT_EQ(scans.scans.size(), 43u);
  const auto results = run_paper_experiment(scans, paper_methods(), 1);
  const auto supported = supported_corners(scans);
  ASSERT_EQ(results.size(), 3u);
  ASSERT_EQ(supported.size(), 43u);
  const PaperResult& altbd = results.front();
  EXPECT_EQ(altbd.method.name, "altbd");
  std::size_t found = 0;
  for (const PoseResult& place : altbd.poses) {
    found += place.true_corners;
    EXPECT_GT(place.time_us, 0);
    ASSERT_TRUE(place.localizer_error_m);
    EXPECT_LT(*place.localizer_error_m, 0.002);
    EXPECT_LT(place.nearest_corners_error_m.value_or(0), 0.2);
  }
  const auto there = std::accumulate(supported.begin(), supported.end(), std::size_t{0});
  EXPECT_GT(there, 43u * 3);
  EXPECT_GT(found, there * 9 / 10);
}

TEST(PaperExperiment, NoRepeats_NoTimes) {
  const auto scans = simulate_paper_scans(contest_maps(), {}, 400, 1);
  const auto results = run_paper_experiment(scans, paper_methods().first(1), 0);
  EXPECT_EQ(results[0].poses[0].time_us, 0);
}

}  // namespace
}  // namespace cornerd::bench
