// SPDX-License-Identifier: MIT
#include "tool/drawing/map_drawing.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>

#include "xml_check.hpp"

namespace cornerd::tool {
namespace {

using core::Vec2;
using testing::HasSubstr;

core::WallMap square_room() {
  core::FloorPlan plan;
  plan.name = "cell <7>";
  plan.walls = {{{0, 0}, {2, 0}, 0.1},
                {{2, 0}, {2, 2}, 0.1},
                {{2, 2}, {0, 2}, 0.1},
                {{0, 2}, {0, 0}, 0.1},
                {{0.5, 1}, {1, 1}, 0}};
  plan.rooms = {{"R&D", {{0, 0}, {2, 0}, {2, 2}, {0, 2}}}};
  return core::WallMap(plan);
}

core::Sample sample(float bearing_rad, float range_m) {
  core::Sample sample;
  sample.bearing_rad = bearing_rad;
  sample.range_m = range_m;
  return sample;
}

TEST(MapDrawing, EveryElement_IsWellFormed) {
  const core::WallMap map = square_room();
  MapDrawing drawing(map);
  core::Scan scan;
  scan.add(sample(0.5F, 1));
  std::array<core::Breakpoint, 2> breakpoints;
  breakpoints[0].position = {0.5, 0.5};
  breakpoints[1].kind = core::BreakpointKind::kTerminal;
  const std::array<Vec2, 2> path = {Vec2(0.5, 0.5), Vec2(1, 1)};
  const core::Pose2 pose{1, 1, 0.3};
  drawing.add_path(path);
  drawing.add_path(path, /*truth=*/true);
  drawing.add_scan(scan, pose);
  drawing.add_breakpoints(breakpoints, pose);
  drawing.add_uncertainty(pose, core::Covariance3::Identity() * 1e-4);
  drawing.add_pose(pose);
  EXPECT_EQ(find_xml_error(drawing.document("a & b")), "");
}

TEST(MapDrawing, Map_ShowsNameRoomsAndCorners) {
  const core::WallMap map = square_room();
  const std::string picture = MapDrawing(map).document("");
  EXPECT_THAT(picture, HasSubstr(">cell &lt;7&gt;</text>"));
  EXPECT_THAT(picture, HasSubstr(">R&amp;D</text>"));
  EXPECT_EQ(count_elements(picture, "circle"), map.corners().size());
}

TEST(MapDrawing, SamplesWithoutReturn_AreNotDrawn) {
  const core::WallMap map = square_room();
  MapDrawing drawing(map);
  core::Scan scan;
  scan.add(sample(0, 0));
  scan.add(sample(0, 1));
  drawing.add_scan(scan, {});
  EXPECT_EQ(count_elements(drawing.document(""), "circle"), map.corners().size() + 1);
}

TEST(MapDrawing, Uncertainty_IsThe95PercentEllipse) {
  const core::WallMap map = square_room();
  MapDrawing drawing(map);
  drawing.add_uncertainty({1, 1, 0}, core::Covariance3::Identity() * 1e-4);
  // 10 mm of sigma, times sqrt(5.991), on a map of 2.1 m that is 900 pixels wide.
  EXPECT_THAT(drawing.document(""), HasSubstr(R"(rx="10.49" ry="10.49")"));
}

}  // namespace
}  // namespace cornerd::tool
