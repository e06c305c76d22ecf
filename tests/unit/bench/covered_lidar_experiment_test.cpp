// SPDX-License-Identifier: MIT
#include "bench/covered_lidar_experiment.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <ostream>
#include <stdexcept>
#include <string>
#include <string_view>

#include "settings/map_file.hpp"

namespace cornerd::bench {
namespace {

CoveredLidarResult run(std::string_view title, std::size_t drives) {
  const auto cases = covered_lidar_cases();
  const auto test_case = std::find_if(
      cases.begin(), cases.end(), [&](const CoveredLidarCase& one) { return one.title == title; });
  if (test_case == cases.end()) throw std::invalid_argument(std::string(title));
  return run_covered_lidar_case(settings::load_map(CORNERD_SOURCE_DIR "/config/maps/flat-7.json"),
                                *test_case, 1, drives);
}

/// The mean of an exact covariance is 3. The bounds are wide, since two drives are few and the
/// filter's noise exceeds these robots' a little.
constexpr double kMinNees = 1.4;
constexpr double kMaxNees = 4;

struct RobotBounds {
  const char* title;
  double max_nees_of_fixes = kMaxNees;
  double max_nees = kMaxNees;
  double min_share = 0.9;  ///< 0.95 for an exact covariance
};

void PrintTo(const RobotBounds& bounds, std::ostream* out) { *out << bounds.title; }

void expect_consistent(const PoseConsistency& poses, double max_nees, double min_share,
                       const std::string& which) {
  EXPECT_GT(poses.poses, 500u) << which;
  EXPECT_GT(poses.mean_nees, kMinNees) << which;
  EXPECT_LT(poses.mean_nees, max_nees) << which;
  EXPECT_GT(poses.share_within, min_share) << which;
}

class CoveredLidarRobot : public testing::TestWithParam<RobotBounds> {};

TEST_P(CoveredLidarRobot, FixesAndPredictions_AreConsistent) {
  const RobotBounds& bounds = GetParam();
  const CoveredLidarResult result = run(bounds.title, 2);
  // Overconfident fixes have a smaller share below kNees95.
  const double min_share = bounds.max_nees_of_fixes > kMaxNees ? 0.7 : bounds.min_share;
  expect_consistent(result.fixes, bounds.max_nees_of_fixes, min_share, "fixes");
  for (const AgeConsistency& ages : result.predicted) {
    expect_consistent(ages, bounds.max_nees, bounds.min_share, std::to_string(ages.from_s));
  }
}

// Without a gyro the covariance is slightly overconfident (src/bench/odometry.md); the bounds hold
// that.
INSTANTIATE_TEST_SUITE_P(Robots, CoveredLidarRobot,
                         testing::Values(RobotBounds{"16 cm robot"}, RobotBounds{"twice the noise"},
                                         RobotBounds{"slips every 3 m"},
                                         RobotBounds{"counts of 5 mm"},
                                         RobotBounds{"Pioneer P3-DX"},
                                         RobotBounds{"Pioneer, slips every 3 m"},
                                         RobotBounds{"no gyro", kMaxNees, 5, 0.8},
                                         RobotBounds{"no gyro, twice the noise", 7, 5, 0.8},
                                         RobotBounds{"Pioneer, no gyro", kMaxNees, 5, 0.8}));

TEST(CoveredLidarExperiment, SlipWithoutGyro_FixesStayConsistent) {
  const PoseConsistency fixes = run("no gyro, slips every 3 m", 2).fixes;
  EXPECT_GT(fixes.poses, 2600u);
  EXPECT_LT(fixes.mean_m, 0.0012);
  EXPECT_LT(fixes.mean_nees, 5.5);
  EXPECT_GT(fixes.share_within, 0.85);
}

TEST(CoveredLidarExperiment, FiveSecondsCovered_ErrorBelowOneCentimetre) {
  for (const AgeConsistency& ages : run("16 cm robot", 1).predicted) {
    EXPECT_LT(ages.worst_m, 0.01) << ages.from_s;
  }
}

TEST(CoveredLidarExperiment, CoarseCounts_ErrorBelowOneCount) {
  for (const AgeConsistency& ages : run("counts of 5 mm", 1).predicted) {
    EXPECT_LT(ages.mean_m, 0.003) << ages.from_s;
  }
}

TEST(CoveredLidarExperiment, BiasedLidar_PredictionsStayConsistent) {
  for (const AgeConsistency& ages : run("a lidar off by 5 mm and 0.5 %", 1).predicted) {
    EXPECT_GT(ages.mean_nees, 1) << ages.from_s;
    EXPECT_LT(ages.mean_nees, 4) << ages.from_s;
    EXPECT_LT(ages.mean_m, 0.002) << ages.from_s;
  }
}

TEST(CoveredLidarExperiment, RandomRobotsAfterThreeSeconds_AreConsistent) {
  // The initial covariance is conservative, so the first range of ages has a small NEES.
  const auto result = run("after 3 s, robots drawn", 4).predicted;
  for (const AgeConsistency& ages : result) EXPECT_LT(ages.mean_nees, 4) << ages.from_s;
  for (std::size_t i = 1; i < result.size(); ++i) {
    EXPECT_GT(result[i].mean_nees, 1.2) << result[i].from_s;
    EXPECT_GT(result[i].share_within, 0.88) << result[i].from_s;
  }
}

TEST(CoveredLidarExperiment, SameSeed_SameResult) {
  const auto one = run("after 3 s, robots drawn", 1).predicted;
  const auto again = run("after 3 s, robots drawn", 1).predicted;
  for (std::size_t i = 0; i < one.size(); ++i) {
    EXPECT_EQ(one[i].poses, again[i].poses);
    EXPECT_EQ(one[i].mean_nees, again[i].mean_nees);
  }
}

}  // namespace
}  // namespace cornerd::bench
