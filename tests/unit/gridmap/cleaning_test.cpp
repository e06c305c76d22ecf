// SPDX-License-Identifier: MIT
#include "gridmap/cleaning.hpp"

#include <gtest/gtest.h>

#include "sketch.hpp"

namespace cornerd::gridmap {
namespace {

TEST(DropSpecks, SmallPatches_BecomeUnknown) {
  OccupancyGrid grid = sketch({"#.....", ".#....", "..#..#", "......"});
  const auto dropped = drop_specks(grid, 2.5);
  ASSERT_EQ(dropped.size(), 1U);
  EXPECT_EQ(dropped[0].cells, 1U);
  EXPECT_EQ(dropped[0].centre, core::Vec2(5.5, 1.5));
  EXPECT_EQ(grid.at(5, 1), Cell::kUnknown);
  EXPECT_EQ(grid.count(Cell::kOccupied), 3U);  // a diagonal hangs together
}

TEST(DropPockets, EnclosedPatches_BecomeUnknownExceptLargest) {
  OccupancyGrid grid = sketch({"#####", "#.#..", "#####"});
  EXPECT_EQ(drop_pockets(grid, 100).size(), 1U);
  EXPECT_EQ(grid.at(1, 1), Cell::kUnknown);
  EXPECT_EQ(grid.count(Cell::kFree), 2U);
}

TEST(Coarser, Cells_AreOccupiedWhereAnyIs) {
  const OccupancyGrid grid = coarser(sketch({"..#??", "...??", "??.??"}), 2);
  ASSERT_EQ(grid.columns(), 3);
  ASSERT_EQ(grid.rows(), 2);
  EXPECT_EQ(grid.at(0, 0), Cell::kFree);
  EXPECT_EQ(grid.at(1, 0), Cell::kFree);
  EXPECT_EQ(grid.at(1, 1), Cell::kOccupied);
  EXPECT_EQ(grid.at(2, 0), Cell::kUnknown);
}

TEST(BuriedShare, SolidBlock_CountsInnerCells) {
  EXPECT_EQ(buried_share(sketch({"....", "####", "...."})), 0);
  EXPECT_NEAR(buried_share(sketch({"###", "###", "###"})), 1.0 / 9, 1e-12);
}

}  // namespace
}  // namespace cornerd::gridmap
