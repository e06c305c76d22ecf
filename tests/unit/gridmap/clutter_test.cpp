// SPDX-License-Identifier: MIT
#include "gridmap/clutter.hpp"

#include <gtest/gtest.h>

#include "sketch.hpp"

namespace cornerd::gridmap {
namespace {

Clutter boxes_of(const std::vector<std::string>& lines) {
  return box_clutter(sketch(lines), 3, 0.5, {});
}

TEST(BoxClutter, ChairLeg_IsOneRectangle) {
  const Clutter clutter = boxes_of({"........", ".####...", ".####...", ".####...", "........"});
  ASSERT_EQ(clutter.walls.size(), 1U);
  const core::Wall& leg = clutter.walls[0];
  EXPECT_NEAR(leg.thickness_m, 2, 1e-9);
  EXPECT_NEAR((leg.to - leg.from).norm() + leg.thickness_m, 3, 1e-9);
  EXPECT_NEAR(((leg.from + leg.to) / 2 - core::Vec2(3, 2.5)).norm(), 0, 1e-9);
}

TEST(BoxClutter, Dot_IsDropped) {
  const Clutter clutter = boxes_of({"......", "..#...", "......"});
  EXPECT_TRUE(clutter.walls.empty());
  ASSERT_EQ(clutter.dropped.size(), 1U);
  EXPECT_NEAR((clutter.dropped[0].centre - core::Vec2(2.5, 1.5)).norm(), 0, 1e-9);
}

TEST(BoxClutter, BentPatch_IsDivided) {
  const Clutter clutter = boxes_of({"#...........", "#...........", "#...........", "#...........",
                                    "#...........", "############"});
  EXPECT_GE(clutter.walls.size(), 2U);
  for (const core::Wall& wall : clutter.walls) EXPECT_LT(wall.thickness_m, 2);
}

}  // namespace
}  // namespace cornerd::gridmap
