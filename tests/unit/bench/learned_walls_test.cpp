// SPDX-License-Identifier: MIT
// What the localizer has learned of walls, against walls that are moved afterwards.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "bench/drawn_plan.hpp"
#include "bench/simulated_drive.hpp"
#include "settings/map_file.hpp"

namespace cornerd::bench {
namespace {

constexpr double kCupboards_m = 0.055;

class LearnedWallsTest : public ::testing::Test {
 protected:
  /// Cupboards along both sides of the outer walls.
  std::shared_ptr<const core::WallMap> furnished() const {
    core::FloorPlan plan = empty_->plan();
    for (std::size_t i = 0; i < 6; ++i) plan.walls[i].thickness_m += 2 * kCupboards_m;
    return std::make_shared<const core::WallMap>(plan);
  }

  /// Drives on with what was learned until now, as after a restart.
  void drive(const std::shared_ptr<const core::WallMap>& building) {
    constexpr double kDrive_s = 120;
    SimulatedDriveConfig config;
    config.scans = static_cast<std::size_t>(kDrive_s * config.simulator.motor_hz);
    const replay::Motion motion = replay::drive_path(
        random_drive(*furnished(), kDrive_s * kSpeed_m_s, 3), gentle_drive(kSpeed_m_s));
    core::FloorPlan plan = empty_->plan();
    plan.sigma_m = 0.05;
    core::LocalizerConfig localizer_config;
    localizer_config.learn_walls = true;
    localizer_config.odometry.enabled = true;
    localizer_config.odometry.geometry = config.robot.geometry;
    core::Localizer localizer(std::make_shared<const core::WallMap>(plan), localizer_config);
    EXPECT_TRUE(localizer.resume(learned_, {}));
    localize_drive(localizer, simulate_drive(building, motion, config), [](auto&&...) {});
    localizer.walls()->copy_to(learned_);
  }
  /// The greatest offset from the map.
  double most_off_m() const {
    double most_m = 0;
    for (const core::WallOffset& wall : learned_.offsets) {
      most_m = std::max(most_m, std::abs(wall.offset_m));
    }
    return most_m;
  }

  static constexpr double kSpeed_m_s = 0.3;
  std::shared_ptr<const core::WallMap> empty_ =
      settings::load_map(CORNERD_SOURCE_DIR "/config/maps/flat-7.json");
  core::LearnedWalls learned_;
};

TEST_F(LearnedWallsTest, CupboardsTakenAway_WallsGoBack) {
  drive(furnished());
  drive(furnished());
  EXPECT_NEAR(most_off_m(), kCupboards_m, 0.01);
  drive(empty_);
  EXPECT_LT(most_off_m(), 0.01);
}

}  // namespace
}  // namespace cornerd::bench
