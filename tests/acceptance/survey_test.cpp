// SPDX-License-Identifier: MIT
// What a survey promises: the walls of a flat of seven rooms from a drive of 100 m with bad
// odometry, to millimetres, and poses in the result as good as in the true map.
#include <gtest/gtest.h>

#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>

#include "bench/survey_experiment.hpp"
#include "settings/map_file.hpp"

namespace cornerd {
namespace {

class SurveyOfAFlat : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    const auto map =
        settings::load_map(std::filesystem::path(CORNERD_SOURCE_DIR) / "config/maps/flat-7.json");
    experiment_ = std::make_unique<bench::SurveyExperiment>(
        bench::run_survey_experiment(map, bench::kSurveyTurns, /*seed=*/20196));
  }
  static void TearDownTestSuite() { experiment_.reset(); }

  static const bench::SurveyCase& made(const std::string& title) {
    for (const bench::SurveyCase& one : experiment_->cases) {
      if (one.title == title) return one;
    }
    throw std::out_of_range(title);
  }
  static std::unique_ptr<bench::SurveyExperiment> experiment_;
};
std::unique_ptr<bench::SurveyExperiment> SurveyOfAFlat::experiment_;

TEST_F(SurveyOfAFlat, EveryWallOver30cmThatWasSeen_IsThereAndNoneIsInvented) {
  EXPECT_GE(experiment_->way_m, 100);
  const bench::SurveyScore& score = made("adjusted").score;
  EXPECT_EQ(score.walls_found, score.walls_seen);
  EXPECT_GT(score.walls_seen, 70U);
  EXPECT_LT(score.invented_m, 0.05);
}

TEST_F(SurveyOfAFlat, Corners_AreRightTo5mmInTheMedianAnd20mmAtMost) {
  const bench::SurveyScore& score = made("adjusted").score;
  EXPECT_EQ(score.corners_found, score.corners_seen);
  EXPECT_GT(score.corners_seen, 40U);
  EXPECT_LE(score.corner_median_m(), 0.005);
  EXPECT_LE(score.corner_max_m(), 0.020);
}

TEST_F(SurveyOfAFlat, SecondDrive_CostsAtMost3mmOverTheTrueMap) {
  const auto& second = made("adjusted").second_drive;
  ASSERT_TRUE(second.has_value());
  EXPECT_EQ(second->wrong, 0U);
  EXPECT_GE(second->named + second->turns / 50, experiment_->in_true_map.named);
  EXPECT_LE(second->mean_error_m, experiment_->in_true_map.mean_error_m + 0.003);
}

TEST_F(SurveyOfAFlat, LidarAlone_FindsTheWallsToo) {
  const bench::SurveyScore& score = made("adjusted, lidar alone").score;
  EXPECT_EQ(score.walls_found, score.walls_seen);
  EXPECT_LT(score.invented_m, 0.05);
  EXPECT_LE(score.corner_median_m(), 0.005);
  EXPECT_LE(score.corner_max_m(), 0.020);
}

TEST_F(SurveyOfAFlat, ThePapersWay_IsFarBehind) {
  const bench::SurveyScore& ours = made("adjusted").score;
  const bench::SurveyScore& taught = made("ransac, odometry taught").score;
  EXPECT_LT(taught.walls_found, ours.walls_found);
  EXPECT_GT(taught.corner_median_m(), 4 * ours.corner_median_m());
}

}  // namespace
}  // namespace cornerd
