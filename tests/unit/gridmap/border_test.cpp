// SPDX-License-Identifier: MIT
#include "gridmap/border.hpp"

#include <gtest/gtest.h>

#include "sketch.hpp"

namespace cornerd::gridmap {
namespace {

TEST(Border, OneCell_IsGoneAroundWithTheFreeOnTheLeft) {
  const auto borders = trace_borders(sketch({"...", ".#.", "..."}));
  ASSERT_EQ(borders.size(), 1U);
  EXPECT_TRUE(borders[0].closed);
  ASSERT_EQ(borders[0].size(), 4U);
  EXPECT_EQ(borders[0].points.front(), borders[0].points.back());
  double area2 = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    area2 += core::cross(borders[0].points[i].place(), borders[0].points[i + 1].place());
  }
  EXPECT_EQ(area2, -2);  // clockwise around what is occupied
}

TEST(Border, OccupiedCellsThatTouchAtACorner_HangTogether) {
  const auto borders = trace_borders(sketch({"....", ".#..", "..#.", "...."}));
  ASSERT_EQ(borders.size(), 1U);
  EXPECT_EQ(borders[0].size(), 8U);
}

TEST(Border, UnknownCells_HaveNone) {
  EXPECT_TRUE(trace_borders(sketch({"??", "??"})).empty());
  EXPECT_TRUE(trace_borders(sketch({"#?.", "#?."})).empty());
  EXPECT_TRUE(trace_borders(sketch({"##", "##"})).empty());
}

TEST(Border, WhereTheUnknownBegins_ItEnds) {
  const auto borders = trace_borders(sketch({"?...?", "#####"}));
  ASSERT_EQ(borders.size(), 1U);
  EXPECT_FALSE(borders[0].closed);
  EXPECT_EQ(borders[0].size(), 3U);
  EXPECT_EQ(borders[0].points.front(), (Border::Point{1, 1}));
  EXPECT_EQ(borders[0].points.back(), (Border::Point{4, 1}));
}

TEST(Border, RoomAndItsPillar_AreTwo) {
  EXPECT_EQ(trace_borders(sketch({"######", "#....#", "#.##.#", "#....#", "######"})).size(), 2U);
}

}  // namespace
}  // namespace cornerd::gridmap
