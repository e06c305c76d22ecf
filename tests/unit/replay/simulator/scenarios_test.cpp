// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "replay/simulator/motion.hpp"
#include "replay/simulator/random_poses.hpp"
#include "settings/map_file.hpp"

namespace cornerd::replay {
namespace {

TEST(Scenarios, AllScenarios_KeepAPioneersWidthFromWalls) {
  const auto map = settings::load_map(CORNERD_SOURCE_DIR "/config/maps/flat-7.json");
  ASSERT_EQ(map->plan().rooms.size(), 7U);
  constexpr double kHalfWidth_m = 0.2;
  for (const Scenario& scenario : scenarios()) {
    DriveConfig drive;
    drive.loop = true;
    const Motion motion = drive_path(scenario.path, drive);
    const double length_s = drive_duration_s(scenario.path, drive);
    for (double t_s = 0; t_s < length_s; t_s += 0.1) {
      const core::Vec2 position = motion(core::from_seconds(t_s), 0).translation();
      for (int k = 0; k < 8; ++k) {
        const core::Vec2 side = position + kHalfWidth_m * core::unit_vector(k * core::kPi / 4);
        ASSERT_FALSE(map->is_solid(side))
            << scenario.name << " at " << position.x() << ',' << position.y();
      }
      ASSERT_TRUE(is_indoors(*map, position)) << scenario.name;
    }
  }
}

TEST(Scenarios, Exploration_VisitsEachRoom) {
  const auto map = settings::load_map(CORNERD_SOURCE_DIR "/config/maps/flat-7.json");
  std::vector<bool> seen(7);
  for (const core::Vec2& point : find_scenario("exploration")->path) {
    const auto room = map->room_at(point);
    ASSERT_TRUE(room);
    seen[*room] = true;
  }
  EXPECT_EQ(seen, std::vector<bool>(7, true));
}

TEST(Scenarios, UnknownName_GivesNull) { EXPECT_EQ(find_scenario("moon"), nullptr); }

}  // namespace
}  // namespace cornerd::replay
