// SPDX-License-Identifier: MIT
#include "gridmap/border_runs.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "sketch.hpp"

namespace cornerd::gridmap {
namespace {

using core::Vec2;

/// Occupied below a line.
OccupancyGrid half_plane(std::size_t columns, std::size_t rows, double height, double slope) {
  OccupancyGrid grid(columns, rows);
  for (std::int64_t row = 0; row < grid.rows(); ++row) {
    for (std::int64_t column = 0; column < grid.columns(); ++column) {
      const double x = static_cast<double>(column) + 0.5;
      const double y = static_cast<double>(row) + 0.5;
      grid.set(column, row, y < height + slope * x ? Cell::kOccupied : Cell::kFree);
    }
  }
  return grid;
}

TEST(StraightRuns, ObliqueWall_IsOneRunToTenthOfCell) {
  for (const double slope : {0.013, 0.1, 0.37, 0.9}) {
    auto borders = trace_borders(half_plane(80, 100, 10.3, slope));
    ASSERT_EQ(borders.size(), 1U) << slope;
    const auto runs = straight_runs(borders[0], 0.75);
    ASSERT_EQ(runs.size(), 1U) << slope;
    EXPECT_NEAR(runs[0].direction.y() / runs[0].direction.x(), slope, 0.004) << slope;
    EXPECT_NEAR(runs[0].at.y() - slope * runs[0].at.x(), 10.3, 0.15) << slope;
  }
}

TEST(StraightRuns, Rectangle_GivesFourRuns) {
  auto borders = trace_borders(sketch({
      "..........",
      ".########.",
      ".########.",
      ".########.",
      ".########.",
      ".########.",
      "..........",
  }));
  ASSERT_EQ(borders.size(), 1U);
  const auto runs = straight_runs(borders[0], 0.75);
  ASSERT_EQ(runs.size(), 4U);
  for (const auto& run : runs) {
    EXPECT_NEAR(std::abs(run.direction.x()) + std::abs(run.direction.y()), 1, 1e-9);
  }
}

TEST(StraightRuns, StepOfOneCell_IsIgnored) {
  OccupancyGrid grid = half_plane(40, 10, 4, 0);
  grid.set(20, 4, Cell::kOccupied);
  grid.set(21, 4, Cell::kOccupied);
  auto borders = trace_borders(grid);
  const auto runs = straight_runs(borders[0], 1.25);
  ASSERT_EQ(runs.size(), 1U);
  EXPECT_NEAR(runs[0].height_of(Vec2(0, 4)), 0, 0.2);
}

TEST(StraightRuns, StepOfThreeCells_IsKept) {
  OccupancyGrid grid = half_plane(40, 12, 4, 0);
  for (std::int64_t column = 20; column < 40; ++column) {
    for (std::int64_t row = 4; row < 7; ++row) grid.set(column, row, Cell::kOccupied);
  }
  auto borders = trace_borders(grid);
  const auto runs = straight_runs(borders[0], 0.75);
  ASSERT_EQ(runs.size(), 3U);
  EXPECT_NEAR(std::abs(runs[1].direction.y()), 1, 1e-9);
  EXPECT_NEAR(runs[1].at.x(), 20, 1e-9);
}

TEST(StraightRuns, WallOfOneCell_GivesTwoRuns) {
  auto borders = trace_borders(sketch({"............", "..#########.", "............"}));
  const auto runs = straight_runs(borders[0], 0.75);
  ASSERT_EQ(runs.size(), 2U);
  EXPECT_LT(runs[0].direction.dot(runs[1].direction), -0.99);
}

TEST(Straightness, Specks_CountInAllBorders) {
  OccupancyGrid grid(60, 20);
  for (std::int64_t column = 0; column < 60; ++column) {
    for (std::int64_t row = 0; row < 20; ++row) {
      const bool is_speck = column % 6 == 2 && row % 3 == 1 && row < 9;
      grid.set(column, row, row < 10 && !is_speck ? Cell::kFree : Cell::kOccupied);
    }
  }
  EXPECT_EQ(straightness(grid).of_long, 1);
  EXPECT_NEAR(straightness(grid).of_all, 60.0 / (60 + 30 * 4), 1e-9);
}

TEST(Straightness, RaggedWall_IsLessStraightThanDrawnOne) {
  OccupancyGrid drawn(60, 20);
  OccupancyGrid ragged(60, 20);
  for (std::int64_t column = 0; column < 60; ++column) {
    for (std::int64_t row = 0; row < 20; ++row) {
      drawn.set(column, row, row < 10 + column / 6 ? Cell::kFree : Cell::kOccupied);
      ragged.set(column, row, row < 10 + column * 7 % 5 ? Cell::kFree : Cell::kOccupied);
    }
  }
  EXPECT_GT(straightness(drawn).of_long, 0.95);
  EXPECT_LT(straightness(ragged).of_long, 0.5);
}

}  // namespace
}  // namespace cornerd::gridmap
