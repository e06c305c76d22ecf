// SPDX-License-Identifier: MIT
#include "gridmap/border.hpp"

#include <gtest/gtest.h>

#include "sketch.hpp"

namespace cornerd::gridmap {
namespace {

TEST(TraceBorders, SingleCell_GivesClosedBorderWithFreeOnLeft) {
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

TEST(TraceBorders, CellsTouchingAtCorner_ShareOneBorder) {
  const auto borders = trace_borders(sketch({"....", ".#..", "..#.", "...."}));
  ASSERT_EQ(borders.size(), 1U);
  EXPECT_EQ(borders[0].size(), 8U);
}

TEST(TraceBorders, UnknownCells_GiveNoBorder) {
  EXPECT_TRUE(trace_borders(sketch({"??", "??"})).empty());
  EXPECT_TRUE(trace_borders(sketch({"#?.", "#?."})).empty());
  EXPECT_TRUE(trace_borders(sketch({"##", "##"})).empty());
}

TEST(TraceBorders, UnknownNeighbour_EndsBorder) {
  const auto borders = trace_borders(sketch({"?...?", "#####"}));
  ASSERT_EQ(borders.size(), 1U);
  EXPECT_FALSE(borders[0].closed);
  EXPECT_EQ(borders[0].size(), 3U);
  EXPECT_EQ(borders[0].points.front(), (Border::Point{1, 1}));
  EXPECT_EQ(borders[0].points.back(), (Border::Point{4, 1}));
}

TEST(TraceBorders, RoomWithPillar_GivesTwoBorders) {
  EXPECT_EQ(trace_borders(sketch({"######", "#....#", "#.##.#", "#....#", "######"})).size(), 2U);
}

}  // namespace
}  // namespace cornerd::gridmap
