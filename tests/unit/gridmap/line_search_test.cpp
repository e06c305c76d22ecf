// SPDX-License-Identifier: MIT
#include "gridmap/line_search.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <utility>

#include "gridmap/face_corners.hpp"

namespace cornerd::gridmap {
namespace {

constexpr double kSlope = 0.1;
constexpr double kHeight = 20.4;  ///< of the wall's surface in column 0

/// Free cells before a wall of three ranges in each column, with noise of 0.7 cells; unknown
/// behind.
OccupancyGrid jagged_wall(std::int64_t columns) {
  OccupancyGrid grid(static_cast<std::size_t>(columns), 60);
  std::mt19937 random(31);
  std::normal_distribution<double> noise(0, 0.7);
  for (std::int64_t column = 0; column < columns; ++column) {
    const double surface = kHeight + kSlope * (static_cast<double>(column) + 0.5);
    for (int beam = 0; beam < 3; ++beam) {
      const auto end = static_cast<std::int64_t>(std::floor(surface + noise(random)));
      for (std::int64_t row = 0; row < end; ++row) {
        if (grid.at(column, row) == Cell::kUnknown) grid.set(column, row, Cell::kFree);
      }
      grid.set(column, end, Cell::kOccupied);
    }
  }
  return grid;
}

void fill(OccupancyGrid& grid, std::int64_t from, std::int64_t to, Cell kind) {
  for (std::int64_t column = from; column < to; ++column) {
    for (std::int64_t row = 0; row < grid.rows(); ++row) grid.set(column, row, kind);
  }
}

double error_at(const GridFace& face, double column) {
  const core::Vec2 surface(column, kHeight + kSlope * column);
  return std::abs(face.height_of(surface));
}

TEST(FindLines, JaggedWall_IsOneLineWithinACell) {
  const MappedLines lines = find_lines(jagged_wall(120), {});
  ASSERT_EQ(lines.faces.size(), 1U);
  EXPECT_NEAR(lines.faces[0].length(), 120 * std::hypot(1, kSlope), 3);
  EXPECT_LT(error_at(lines.faces[0], 0), 0.6);
  EXPECT_LT(error_at(lines.faces[0], 120), 0.6);
}

TEST(FindLines, GapBehindFurniture_IsClosed) {
  OccupancyGrid grid = jagged_wall(120);
  fill(grid, 50, 65, Cell::kUnknown);
  const MappedLines lines = find_lines(grid, {});
  EXPECT_EQ(lines.faces.size(), 1U);
  ASSERT_EQ(lines.gaps.size(), 1U);
  EXPECT_NEAR(lines.gaps[0].length, 15, 2);
  EXPECT_NEAR(lines.gaps[0].centre.x(), 57.5, 1.5);
}

TEST(FindLines, LongGapOrDoor_StaysOpen) {
  OccupancyGrid grid = jagged_wall(160);
  fill(grid, 50, 80, Cell::kUnknown);
  EXPECT_EQ(find_lines(grid, {}).faces.size(), 2U);
  grid = jagged_wall(160);
  fill(grid, 50, 60, Cell::kFree);
  EXPECT_EQ(find_lines(grid, {}).faces.size(), 2U);
}

TEST(FindLines, CloudOfDots_HasHardlyAnyLine) {
  OccupancyGrid grid(60, 60);
  std::mt19937 random(32);
  for (std::int64_t row = 0; row < 60; ++row) {
    for (std::int64_t column = 0; column < 60; ++column) {
      grid.set(column, row, random() % 4 == 0 ? Cell::kOccupied : Cell::kFree);
    }
  }
  EXPECT_LE(find_lines(grid, {}).faces.size(), 5U);
}

std::pair<GridFace, GridFace> joined(const OccupancyGrid& grid) {
  std::vector<GridFace> faces = {{{5, 10}, {30, 10}, {1, 0}}, {{40, 20}, {40, 50}, {0, 1}}};
  join_corners(grid, 4, 20, faces);
  return {faces[0], faces[1]};
}

TEST(JoinCorners, CornerBehindUnknownCells_IsClosed) {
  const auto [one, other] = joined(OccupancyGrid(60, 60));
  EXPECT_NEAR((one.to - core::Vec2(40, 10)).norm(), 0, 1e-9);
  EXPECT_NEAR((other.from - core::Vec2(40, 10)).norm(), 0, 1e-9);
}

TEST(JoinCorners, FreeCellsBetween_StayOpen) {
  OccupancyGrid grid(60, 60);
  fill(grid, 33, 36, Cell::kFree);
  const auto [one, other] = joined(grid);
  EXPECT_EQ(one.to.x(), 30);
  EXPECT_EQ(other.from.y(), 20);
}

TEST(JoinCorners, EndPastACorner_IsCut) {
  std::vector<GridFace> faces = {{{5, 10}, {42, 10}, {1, 0}}, {{40, 8}, {40, 50}, {0, 1}}};
  join_corners(OccupancyGrid(60, 60), 4, 4, faces);
  EXPECT_NEAR((faces[0].to - core::Vec2(40, 10)).norm(), 0, 1e-9);
  EXPECT_NEAR((faces[1].from - core::Vec2(40, 10)).norm(), 0, 1e-9);
}

}  // namespace
}  // namespace cornerd::gridmap
