// SPDX-License-Identifier: MIT
#include "survey/ransac_survey.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <stdexcept>

#include "bench/simulated_drive.hpp"

namespace cornerd::survey {
namespace {

using core::Vec2;

/// A room of 4 x 3 m, driven through with wheels as configured.
RecordedDrive drive_in_a_room(std::size_t scans, bool has_odometry) {
  core::FloorPlan plan;
  plan.walls = {{{0, 0}, {4, 0}, 0}, {{4, 0}, {4, 3}, 0}, {{4, 3}, {0, 3}, 0}, {{0, 3}, {0, 0}, 0}};
  bench::SimulatedDriveConfig config;
  config.scans = scans;
  config.has_odometry = has_odometry;
  replay::DriveConfig drive;
  drive.loop = true;
  return bench::simulate_drive(std::make_shared<const core::WallMap>(plan),
                               replay::drive_path({{1, 1}, {3, 1.2}, {2, 2}}, drive), config)
      .drive;
}

TEST(RansacSurvey, Room_GivesFourWalls) {
  const SurveyResult result = ransac_survey(drive_in_a_room(120, true), {}, {});
  std::size_t longest = 0;
  for (const core::Wall& wall : result.plan.walls) {
    EXPECT_EQ(wall.thickness_m, 0);
    longest += (wall.to - wall.from).norm() > 2.5 ? 1 : 0;
  }
  EXPECT_GE(longest, 4U);
  EXPECT_EQ(result.T_map_base.size(), 120U);
}

TEST(RansacSurvey, LongerRecording_GivesSimilarNumberOfPoints) {
  const SurveyResult once = ransac_survey(drive_in_a_room(100, true), {}, {});
  const SurveyResult thrice = ransac_survey(drive_in_a_room(300, true), {}, {});
  EXPECT_NEAR(static_cast<double>(thrice.points.size()), static_cast<double>(once.points.size()),
              0.5 * static_cast<double>(once.points.size()));
}

TEST(RansacSurvey, WithoutOdometry_Throws) {
  EXPECT_THROW(ransac_survey(drive_in_a_room(20, false), {}, {}), std::invalid_argument);
}

TEST(RansacSurvey, SameSeed_GivesSameLines) {
  const RecordedDrive drive = drive_in_a_room(60, true);
  const SurveyResult one = ransac_survey(drive, {}, {});
  const SurveyResult other = ransac_survey(drive, {}, {});
  ASSERT_EQ(one.plan.walls.size(), other.plan.walls.size());
  EXPECT_EQ(one.plan.walls.front().from, other.plan.walls.front().from);
}

TEST(ThinOut, PointsInOneCell_BecomeTheirMean) {
  const auto thin = thin_out({{0.101, 0.101}, {0.103, 0.105}, {1.001, 0.101}}, 0.02);
  ASSERT_EQ(thin.size(), 2U);
  EXPECT_NEAR(thin[0].x(), 0.102, 1e-12);
}

TEST(ThinOut, StrayReturns_AreLeftOut) {
  std::vector<Vec2> points(100, Vec2(0.5, 0.5));
  points.emplace_back(2, 2);
  EXPECT_EQ(thin_out(points, 0.02).size(), 1U);
}

}  // namespace
}  // namespace cornerd::survey
