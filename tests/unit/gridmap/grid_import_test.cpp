// SPDX-License-Identifier: MIT
#include "gridmap/grid_import.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <utility>

#include "drawn_map.hpp"
#include "settings/map_file.hpp"
#include "sketch.hpp"

namespace cornerd::gridmap {
namespace {

core::WallMap sample_map(const char* name) {
  return core::WallMap(
      settings::load_map(std::string(CORNERD_SOURCE_DIR "/config/maps/") + name)->plan());
}

ImportResult import_drawn(const DrawnMap& drawn) {
  return import_grid(drawn.grid, drawn.resolution_m, drawn.T_map_picture, {});
}

TEST(GridImport, DrawnFlat_IsAccurateToHalfACell) {
  const core::WallMap flat = sample_map("flat-7.json");
  for (const double yaw_rad : {0.0, 0.2}) {
    const DrawnMap drawn = draw_map(flat, 0.05, yaw_rad);
    const ImportResult result = import_drawn(drawn);
    EXPECT_EQ(result.made_by, MadeBy::kDrawing);
    const ImportScore score = score_import(flat, core::WallMap(result.plan), drawn);
    SCOPED_TRACE(score.text());
    EXPECT_GE(score.corner_errors_m.size(), score.corners - 2);
    EXPECT_LT(score.max_m(), 0.0354);  // half a cell both ways
    EXPECT_LE(score.invented_corners, 2U);
    EXPECT_EQ(score.missed_m, 0);
    EXPECT_EQ(score.invented_m, 0);
  }
}

TEST(GridImport, RotatedPicture_IsAccurateBelowCellSize) {
  const core::WallMap flat = sample_map("flat-7.json");
  const DrawnMap drawn = draw_map(flat, 0.05, 0.2);
  const core::WallMap imported(import_drawn(drawn).plan);
  EXPECT_LT(score_import(flat, imported, drawn).median_m(), 0.004);
}

TEST(GridImport, MappedByLidar_HasSurfacesInMiddleOfCells) {
  const core::WallMap arena = sample_map("krpai-2019-a.json");
  const DrawnMap drawn = scan_map(arena, 0.02, 0.2, 0.01, 25);
  const ImportResult result = import_drawn(drawn);
  EXPECT_EQ(result.made_by, MadeBy::kLidar);
  const ImportScore score = score_import(arena, core::WallMap(result.plan), drawn);
  SCOPED_TRACE(score.text());
  EXPECT_GE(score.corner_errors_m.size(), score.corners - 1);
  EXPECT_LT(score.median_m(), 0.005);
  EXPECT_LT(score.missed_m, 0.1);
  EXPECT_LT(score.invented_m, 0.1);
}

/// A room of 8 x 5 m with a cabinet before a wall and two chair legs, and where ranges to its walls
/// are measured.
constexpr double kRoomWidth_m = 8;
constexpr double kRoomDepth_m = 5;
const core::Vec2 kRoomMiddle(4, 2.5);

core::WallMap furnished_room() {
  core::FloorPlan plan;
  const core::Vec2 corners[] = {{0, 0}, {8, 0}, {8, 5}, {0, 5}};
  for (int i = 0; i < 4; ++i) plan.walls.push_back({corners[i], corners[(i + 1) % 4], 0});
  plan.walls.push_back({{2.2, 0.5}, {2.6, 0.5}, 0.3});
  plan.walls.push_back({{5.5, 3.4}, {5.6, 3.4}, 0.1});
  plan.walls.push_back({{6.1, 3.4}, {6.2, 3.4}, 0.1});
  return core::WallMap(std::move(plan));
}

/// Noise of two cells, from few places, and dots.
DrawnMap noisy_picture(const core::WallMap& room, double yaw_rad) {
  DrawnMap drawn = scan_map(room, 0.03, yaw_rad, 0.04, 20);
  std::mt19937 random(20196);
  for (int dot = 0; dot < 60; ++dot) {
    const auto column = static_cast<std::int64_t>(random() % drawn.grid.columns());
    const auto row = static_cast<std::int64_t>(random() % drawn.grid.rows());
    if (drawn.grid.at(column, row) == Cell::kFree) drawn.grid.set(column, row, Cell::kOccupied);
  }
  return drawn;
}

TEST(GridImport, NoisyMapOfFurnishedRoom_HasFewLongWalls) {
  const core::WallMap room = furnished_room();
  for (const double yaw_rad : {0.0, 0.2}) {
    const ImportResult result = import_drawn(noisy_picture(room, yaw_rad));
    EXPECT_EQ(result.made_by, MadeBy::kLidar);
    EXPECT_GE(result.specks.size(), 30U);
    EXPECT_LE(result.plan.walls.size(), 16U);
    const core::WallMap imported(result.plan);
    for (int quarter = 0; quarter < 4; ++quarter) {
      const double angle_rad = quarter * core::kPi / 2;
      const double range_m = (quarter % 2 == 0 ? kRoomWidth_m : kRoomDepth_m) / 2;
      EXPECT_NEAR(imported.range_along(kRoomMiddle, angle_rad, 12), range_m, 0.03) << quarter;
    }
    for (const core::Vec2& corner : {core::Vec2(0, 5), core::Vec2(8, 0)}) {
      const double angle_rad = core::angle_of(corner - kRoomMiddle);
      EXPECT_NEAR(imported.range_along(kRoomMiddle, angle_rad, 12), (corner - kRoomMiddle).norm(),
                  0.08);
    }
    // The wall behind the cabinet is one.
    const auto faces = imported.faces();
    EXPECT_TRUE(std::any_of(faces.begin(), faces.end(), [](const core::Face& face) {
      return face.normal.y() > 0.99 && std::abs(face.offset_m) < 0.05 &&
             face.length_m > kRoomWidth_m - 0.2;
    }));
  }
}

TEST(GridImport, NoisyPictureWithoutUnknownCells_IsMadeByLidar) {
  DrawnMap drawn = noisy_picture(furnished_room(), 0.2);
  for (std::int64_t row = 0; row < drawn.grid.rows(); ++row) {
    for (std::int64_t column = 0; column < drawn.grid.columns(); ++column) {
      if (drawn.grid.at(column, row) == Cell::kUnknown) drawn.grid.set(column, row, Cell::kFree);
    }
  }
  EXPECT_EQ(import_drawn(drawn).made_by, MadeBy::kLidar);
}

TEST(GridImport, ThickWallsWithRaggedBacks_AreNoDrawing) {
  std::mt19937 random(20197);
  const auto picture = [&](bool is_ragged) {
    OccupancyGrid grid(100, 40);
    for (std::int64_t column = 0; column < 100; ++column) {
      const std::int64_t top = is_ragged ? 34 + static_cast<std::int64_t>(random() % 4) : 36;
      for (std::int64_t row = 0; row < top; ++row) {
        grid.set(column, row, row < 30 ? Cell::kFree : Cell::kOccupied);
      }
    }
    return grid;
  };
  EXPECT_EQ(import_grid(picture(true), 0.05, {}, {}).made_by, MadeBy::kLidar);
  EXPECT_EQ(import_grid(picture(false), 0.05, {}, {}).made_by, MadeBy::kDrawing);
}

TEST(GridImport, ThinWalls_AreLinesOrOfGivenThickness) {
  const OccupancyGrid grid = sketch({"??????????", "?........?", "?.######.?", "?........?"});
  ImportOptions options;
  options.made_by = MadeBy::kLidar;
  ImportResult result = import_grid(grid, 0.05, {}, options);
  ASSERT_EQ(result.plan.walls.size(), 1U);
  EXPECT_EQ(result.plan.walls[0].thickness_m, 0);
  options.thin_m = 0.018;
  result = import_grid(grid, 0.05, {}, options);
  EXPECT_NEAR(result.plan.walls[0].thickness_m, 0.018, 1e-9);
}

TEST(GridImport, UnknownGapAndDoor_ClosesGapOnly) {
  const auto walls_of = [](const char* wall) {
    const OccupancyGrid grid = sketch({"????????????????????????", wall, "........................",
                                       "........................", "########################"});
    return import_grid(grid, 0.05, {}, {.made_by = MadeBy::kDrawing});
  };
  const ImportResult unknown = walls_of("##########????##########");
  EXPECT_EQ(unknown.plan.walls.size(), 2U);
  ASSERT_EQ(unknown.joined_gaps.size(), 1U);
  EXPECT_NEAR(unknown.joined_gaps[0].size_m, 0.2, 1e-9);
  const ImportResult door = walls_of("##########....##########");
  EXPECT_EQ(door.plan.walls.size(), 3U);
  EXPECT_TRUE(door.joined_gaps.empty());
}

TEST(GridImport, EndOfKnowledge_IsOpenAndDoorIsNot) {
  const OccupancyGrid grid = sketch({"????????????????????????", "##########....##########",
                                     "........................", "........................"});
  const ImportResult result = import_grid(grid, 0.05, {}, {.made_by = MadeBy::kDrawing});
  ASSERT_EQ(result.plan.walls.size(), 2U);
  for (const core::Wall& wall : result.plan.walls) {
    for (const std::size_t end : {0U, 1U}) {
      const double x = end == 0 ? wall.from.x() : wall.to.x();
      EXPECT_EQ(wall.is_open[end], x < 0.2 || x > 1) << x;
    }
  }
}

TEST(GridImport, Sigma_IsHalfACellOrMore) {
  const core::WallMap arena = sample_map("krpai-2019-a.json");
  const core::WallMap flat = sample_map("flat-7.json");
  EXPECT_EQ(import_drawn(draw_map(flat, 0.05, 0)).plan.sigma_m, 0.025);
  EXPECT_EQ(import_drawn(draw_map(flat, 0.01, 0)).plan.sigma_m, 0.01);
  EXPECT_EQ(import_drawn(scan_map(arena, 0.02, 0.2, 0.01, 25)).plan.sigma_m, 0.02);
}

TEST(GridImport, CellsFinerThanNoise_AreJoined) {
  const core::WallMap room = furnished_room();
  const ImportResult result = import_drawn(scan_map(room, 0.01, 0.2, 0.04, 20));
  EXPECT_EQ(result.made_by, MadeBy::kLidar);
  EXPECT_GT(result.cell_m, 0.015);
  EXPECT_LE(result.plan.walls.size(), 16U);
  const core::WallMap imported(result.plan);
  for (int quarter = 0; quarter < 4; ++quarter) {
    const double range_m = (quarter % 2 == 0 ? kRoomWidth_m : kRoomDepth_m) / 2;
    EXPECT_NEAR(imported.range_along(kRoomMiddle, quarter * core::kPi / 2, 12), range_m, 0.03);
  }
}

TEST(GridImport, SpecksAndPockets_AreReported) {
  const OccupancyGrid grid =
      sketch({"####################", "#..................#", "#....#.........###.#",
              "#..............#.#.#", "#..............###.#", "#..................#",
              "####################"});
  const ImportResult result = import_grid(grid, 0.05, {1, 2, 0}, {});
  ASSERT_EQ(result.specks.size(), 1U);
  EXPECT_NEAR(result.specks[0].place.x(), 1 + 5.5 * 0.05, 1e-9);
  EXPECT_NEAR(result.specks[0].place.y(), 2 + 4.5 * 0.05, 1e-9);
  EXPECT_EQ(result.pockets.size(), 1U);
}

TEST(GridImport, NoBorder_GivesNoWalls) {
  EXPECT_TRUE(import_grid(OccupancyGrid(5, 5), 0.05, {}, {}).plan.walls.empty());
  EXPECT_TRUE(import_grid(sketch({"....", "...."}), 0.05, {}, {}).plan.walls.empty());
}

TEST(GridImport, RandomPictures_GiveValidMaps) {
  std::mt19937 random(20194);
  for (int trial = 0; trial < 60; ++trial) {
    OccupancyGrid grid(24, 17);
    const unsigned denseness = 1 + trial % 5;
    for (std::int64_t row = 0; row < grid.rows(); ++row) {
      for (std::int64_t column = 0; column < grid.columns(); ++column) {
        const unsigned dice = random() % 8;
        grid.set(column, row,
                 dice < denseness ? Cell::kOccupied
                 : dice == 7      ? Cell::kUnknown
                                  : Cell::kFree);
      }
    }
    for (const MadeBy made_by : {MadeBy::kDrawing, MadeBy::kLidar}) {
      ImportResult result = import_grid(grid, 0.05, {1, -2, 0.3}, {.made_by = made_by});
      if (result.plan.walls.empty()) continue;
      EXPECT_NO_THROW(core::WallMap(std::move(result.plan)));
    }
  }
}

}  // namespace
}  // namespace cornerd::gridmap
