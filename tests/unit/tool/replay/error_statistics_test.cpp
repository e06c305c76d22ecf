// SPDX-License-Identifier: MIT
#include "tool/replay/error_statistics.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cornerd::tool {
namespace {

using core::PoseState;
using testing::HasSubstr;
using testing::Not;

core::PoseEstimate estimate(PoseState state, double x_m, double y_m, double theta_rad) {
  core::PoseEstimate estimate;
  estimate.state = state;
  estimate.T_map_base = {x_m, y_m, theta_rad};
  estimate.covariance.diagonal() << 1e-4, 1e-4, 1e-4;
  return estimate;
}

TEST(ErrorStatistics, NoPoses_AreReportedWithoutDivision) {
  const ErrorStatistics statistics;
  EXPECT_EQ(statistics.mean_error_m(), 0);
  EXPECT_EQ(statistics.mean_nees(), 0);
  EXPECT_THAT(statistics.report(), Not(HasSubstr("nan")));
}

TEST(ErrorStatistics, PositionErrors_AreEuclidean) {
  ErrorStatistics statistics;
  statistics.add(estimate(PoseState::kFix, 1.003, 2.004, 0), {1, 2, 0});
  statistics.add(estimate(PoseState::kTracking, 1, 2.001, 0), {1, 2, 0});
  EXPECT_NEAR(statistics.mean_error_m(), 0.003, 1e-12);
  EXPECT_NEAR(statistics.max_error_m(), 0.005, 1e-12);
  EXPECT_EQ(statistics.scans(), 2U);
  EXPECT_EQ(statistics.count(PoseState::kFix), 1U);
  EXPECT_EQ(statistics.wrong(), 0U);
}

TEST(ErrorStatistics, Nees_WeightsErrorsByCovariance) {
  ErrorStatistics statistics;
  // One sigma (10 mm, 10 mrad) in each of the three.
  statistics.add(estimate(PoseState::kFix, 0.01, -0.01, 0.01), {0, 0, 0});
  EXPECT_NEAR(statistics.mean_nees(), 3, 1e-9);
}

TEST(ErrorStatistics, SingularCovariance_IsOmittedFromNees) {
  ErrorStatistics statistics;
  core::PoseEstimate certain = estimate(PoseState::kFix, 0.01, 0, 0);
  certain.covariance.setZero();
  statistics.add(certain, {0, 0, 0});
  EXPECT_EQ(statistics.mean_nees(), 0);
  EXPECT_THAT(statistics.report(), Not(HasSubstr("nees")));
}

TEST(ErrorStatistics, ErrorAbove10CentimetresOr5Degrees_IsWrong) {
  ErrorStatistics statistics;
  statistics.add(estimate(PoseState::kFix, 0.099, 0, 0), {0, 0, 0});
  EXPECT_EQ(statistics.wrong(), 0U);
  statistics.add(estimate(PoseState::kFix, 0.101, 0, 0), {0, 0, 0});
  EXPECT_EQ(statistics.wrong(), 1U);
  statistics.add(estimate(PoseState::kFix, 0, 0, core::radians(5.1)), {0, 0, 0});
  EXPECT_EQ(statistics.wrong(), 2U);
}

TEST(ErrorStatistics, HeadingsAcrossPi_AreClose) {
  ErrorStatistics statistics;
  statistics.add(estimate(PoseState::kFix, 0, 0, core::kPi - 0.01), {0, 0, -core::kPi + 0.01});
  EXPECT_EQ(statistics.wrong(), 0U);
}

TEST(ErrorStatistics, AmbiguousAndLost_AreNeverWrong) {
  ErrorStatistics statistics;
  core::PoseEstimate ambiguous = estimate(PoseState::kAmbiguous, 9, 9, 0);
  ambiguous.alternatives = {{{5, 5, 0}, 0.6}, {{0.01, 0, 0}, 0.4}};
  statistics.add(ambiguous, {0, 0, 0});
  ambiguous.alternatives.pop_back();
  statistics.add(ambiguous, {0, 0, 0});
  statistics.add(estimate(PoseState::kLost, 9, 9, 0), {0, 0, 0});
  EXPECT_EQ(statistics.wrong(), 0U);
  EXPECT_EQ(statistics.ambiguous_with_truth(), 1U);
  EXPECT_THAT(statistics.report(), HasSubstr("1 of 2 list the true pose"));
}

TEST(ErrorStatistics, Report_HasQuantiles) {
  ErrorStatistics statistics;
  for (int mm = 1; mm <= 20; ++mm) {
    statistics.add(estimate(PoseState::kFix, mm * 1e-3, 0, 0), {0, 0, 0});
  }
  statistics.add_unknown();
  const std::string report = statistics.report();
  EXPECT_THAT(report, HasSubstr("mean 10.50  median 10.00  95 % 19.00  max 20.00 mm"));
  EXPECT_THAT(report, HasSubstr("1 scans outside the truth's time"));
}

}  // namespace
}  // namespace cornerd::tool
