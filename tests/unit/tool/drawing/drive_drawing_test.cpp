// SPDX-License-Identifier: MIT
#include "tool/drawing/drive_drawing.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

#include "xml_check.hpp"

namespace cornerd::tool {
namespace {

using testing::HasSubstr;

TEST(DriveDrawing, TracksWithoutMap_AreWellFormedAndNamed) {
  const std::vector<core::Vec2> path = {{0, 0}, {1, 0}, {1, 5}};
  const DrawnTrack tracks[] = {{"by <the> lidar", "#000000", path, true},
                               {"wheels", "#c2255c", path, false}};
  const std::string svg = draw_drive("A drive & more", tracks, nullptr);
  EXPECT_EQ(find_xml_error(svg), "");
  EXPECT_THAT(svg, HasSubstr("wheels"));
  EXPECT_THAT(svg, HasSubstr("stroke-dasharray"));
}

TEST(DriveDrawing, NoPoints_GivesEmptyDrawing) {
  const DrawnTrack tracks[] = {{"nothing", "#000000", {}, false}};
  EXPECT_EQ(find_xml_error(draw_drive("none", tracks, nullptr)), "");
}

TEST(DriveDrawing, EqualPoints_AreDrawnOnce) {
  std::vector<core::Vec2> path(1000, {0, 0});
  path.emplace_back(10, 0);
  const DrawnTrack tracks[] = {{"stands, then drives", "#000000", path, false}};
  EXPECT_LT(draw_drive("few", tracks, nullptr).size(), 5000u);
}

}  // namespace
}  // namespace cornerd::tool
