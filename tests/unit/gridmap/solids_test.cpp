// SPDX-License-Identifier: MIT
#include "gridmap/solids.hpp"

#include <gtest/gtest.h>

#include "sketch.hpp"

namespace cornerd::gridmap {
namespace {

TEST(Uncovered, OverlappingIntervals_GiveTheRest) {
  const auto open = uncovered(10, {{4, 6}, {-1, 1}, {5, 7}});
  ASSERT_EQ(open.size(), 2U);
  EXPECT_EQ(open[0].begin, 1);
  EXPECT_EQ(open[0].end, 4);
  EXPECT_EQ(open[1].begin, 7);
  EXPECT_EQ(open[1].end, 10);
  EXPECT_TRUE(uncovered(2, {{-1, 3}}).empty());
}

TEST(Covered, WallInFrontOfFace_CoversNothing) {
  const GridFace face{.from = {0, 0}, .to = {10, 0}, .direction = {1, 0}};
  const core::WallBox behind(core::Wall{{2, -1}, {6, -1}, 2});
  const core::WallBox before(core::Wall{{4, 1.5}, {4, 8}, 3});
  const Interval part = covered(face, behind, 0.5);
  EXPECT_NEAR(part.begin, 0.5, 1e-9);
  EXPECT_NEAR(part.end, 7.5, 1e-9);
  EXPECT_LE(covered(face, before, 0.5).length(), 0);
}

std::vector<core::Wall> solids_of(const std::vector<std::string>& lines, double thickness) {
  const OccupancyGrid grid = sketch(lines);
  const FaceSet set = build_faces(grid, trace_borders(grid), {});
  SolidLimits limits;
  limits.thickness = thickness;
  limits.block = thickness;
  return find_solids(grid, set.faces, limits);
}

TEST(FindSolids, FreeStandingWall_IsFound) {
  const auto walls = solids_of({"............", ".##########.", ".##########.", "............"}, 5);
  ASSERT_EQ(walls.size(), 1U);
  EXPECT_NEAR(walls[0].thickness_m, 2, 1e-6);
  EXPECT_NEAR((walls[0].to - walls[0].from).norm(), 8, 1e-6);
}

TEST(FindSolids, FacesOfCorridor_AreNotPaired) {
  EXPECT_TRUE(
      solids_of(
          {"??????????", "##########", "..........", "..........", "##########", "??????????"}, 5)
          .empty());
}

TEST(FindSolids, UnknownInside_IsSolidUpToLimit) {
  const std::vector<std::string> hollow = {"..........", "##########", "??????????",
                                           "??????????", "##########", ".........."};
  EXPECT_EQ(solids_of(hollow, 5).size(), 1U);
  EXPECT_TRUE(solids_of(hollow, 3).empty());
}

}  // namespace
}  // namespace cornerd::gridmap
