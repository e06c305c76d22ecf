// SPDX-License-Identifier: MIT
// A survey of a flat of seven rooms from a drive of 100 m with erroneous odometry: walls to
// millimetres, and poses in its map as accurate as in the true map.
#include <gtest/gtest.h>

#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>

#include "bench/simulated_drive.hpp"
#include "bench/survey_experiment.hpp"
#include "bench/survey_scoring.hpp"
#include "replay/simulator/motion.hpp"
#include "settings/map_file.hpp"

namespace cornerd {
namespace {

class SurveyOfAFlat : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    const auto map =
        settings::load_map(std::filesystem::path(CORNERD_SOURCE_DIR) / "config/maps/flat-7.json");
    experiment_ = std::make_unique<bench::SurveyExperiment>(
        bench::run_survey_experiment(map, bench::kSurveyScans, /*seed=*/20196));
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

TEST_F(SurveyOfAFlat, VisibleWallsOver30cm_AreMappedWithoutFalseOnes) {
  EXPECT_GE(experiment_->length_m, 100);
  const bench::SurveyScore& score = made("adjusted").score;
  EXPECT_EQ(score.walls_found, score.walls_visible);
  EXPECT_GT(score.walls_visible, 70U);
  EXPECT_LT(score.invented_m, 0.05);
}

TEST_F(SurveyOfAFlat, Corners_MedianErrorBelow5mmAndMaxBelow20mm) {
  const bench::SurveyScore& score = made("adjusted").score;
  EXPECT_EQ(score.corners_found, score.corners_visible);
  EXPECT_GT(score.corners_visible, 40U);
  EXPECT_LE(score.corner_median_m(), 0.005);
  EXPECT_LE(score.corner_max_m(), 0.020);
}

TEST_F(SurveyOfAFlat, SecondDrive_ErrorAtMost3mmAboveTrueMap) {
  const auto& second = made("adjusted").second_drive;
  ASSERT_TRUE(second.has_value());
  EXPECT_EQ(second->wrong, 0U);
  EXPECT_GE(second->named + second->scans / 50, experiment_->in_true_map.named);
  EXPECT_LE(second->mean_error_m, experiment_->in_true_map.mean_error_m + 0.003);
}

TEST_F(SurveyOfAFlat, LidarAlone_FindsTheWalls) {
  const bench::SurveyScore& score = made("adjusted, lidar alone").score;
  EXPECT_EQ(score.walls_found, score.walls_visible);
  EXPECT_LT(score.invented_m, 0.05);
  EXPECT_LE(score.corner_median_m(), 0.005);
  EXPECT_LE(score.corner_max_m(), 0.020);
}

TEST_F(SurveyOfAFlat, PaperMethod_IsLessAccurate) {
  const bench::SurveyScore& ours = made("adjusted").score;
  const bench::SurveyScore& calibrated = made("ransac, calibrated odometry").score;
  EXPECT_LT(calibrated.walls_found, ours.walls_found);
  EXPECT_GT(calibrated.corner_median_m(), 4 * ours.corner_median_m());
}

/// Starts and stops within one scan distort it by up to 12 degrees. Matched at an impossible pose,
/// one such scan displaced the map by 0.8 m.
TEST(SurveyByTheLidarAlone, AbruptStartsAndStops_MapIsRight) {
  const auto map =
      settings::load_map(std::filesystem::path(CORNERD_SOURCE_DIR) / "config/maps/flat-7.json");
  const replay::Scenario* exploration = replay::find_scenario("exploration");
  struct Case {
    double speed_m_s;
    std::uint64_t seed;
  };
  for (const auto& [speed_m_s, seed] : {Case{0.4, 1}, Case{0.3, 2}}) {
    replay::DriveConfig how;
    how.speed_m_s = speed_m_s;
    bench::SimulatedDriveConfig config;
    config.simulator.seed = seed;
    config.has_odometry = false;
    config.scans = speed_m_s > 0.35 ? 1260 : 1600;
    const bench::SimulatedDrive driven =
        bench::simulate_drive(map, replay::drive_path(exploration->path, how), config);
    const survey::SurveyResult result = survey::survey(driven.drive, {});
    const core::WallMap found(result.plan);
    const bench::SurveyScore score =
        bench::score_survey(*map, driven.T_map_base, found, driven.T_map_base.front());
    EXPECT_EQ(score.walls_found, score.walls_visible) << speed_m_s;
    EXPECT_LT(score.invented_m, 0.1) << speed_m_s;
    EXPECT_LE(score.corner_max_m(), 0.020) << speed_m_s;
  }
}

}  // namespace
}  // namespace cornerd
