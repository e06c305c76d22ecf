// SPDX-License-Identifier: MIT
#include "tool/drawing/metre_plot.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <regex>
#include <string>
#include <vector>

#include "xml_check.hpp"

namespace cornerd::tool {
namespace {

using core::Vec2;
using testing::HasSubstr;

/// A square room of 4 m with the lidar in its middle, 100 returns a wall.
std::vector<Vec2> room() {
  std::vector<Vec2> points;
  for (int i = 0; i < 100; ++i) {
    const double along_m = -2 + 0.04 * i;
    for (const Vec2& point :
         {Vec2(along_m, -2), Vec2(along_m, 2), Vec2(-2, along_m), Vec2(2, along_m)}) {
      points.push_back(point);
    }
  }
  return points;
}

TEST(BoundsWithoutOutliers, OutliersDoNotShrinkTheRoom) {
  std::vector<Vec2> points = room();
  points.emplace_back(12, 0);
  points.emplace_back(0, -9);
  const Rectangle area = bounds_without_outliers(points);
  EXPECT_LT((area.high - area.low).maxCoeff(), 4.5);
  for (const Vec2& point : room()) EXPECT_TRUE(area.contains(point)) << point.transpose();
}

TEST(BoundsWithoutOutliers, FewPoints_AreAllInside) {
  const std::vector<Vec2> points = {{0, 0}, {1, 0}, {1, 5}};
  const Rectangle area = bounds_without_outliers(points);
  for (const Vec2& point : points) EXPECT_TRUE(area.contains(point)) << point.transpose();
}

TEST(BoundsWithoutOutliers, NoPoints_GiveARectangle) {
  EXPECT_TRUE(bounds_without_outliers({}).contains(Vec2::Zero()));
}

TEST(MetrePlot, Axes_HaveUnitsAndTheLegendIsAboveTheArea) {
  const LegendLine legend[] = {{"wheels & gyro", {.stroke = "#c2255c"}},
                               {"corners", {.stroke = "#c0392b"}, LegendLine::Mark::kRing}};
  MetrePlot plot({Vec2(0, 0), Vec2(3, 2)}, "A drive", legend);
  const std::string empty = plot.document();
  EXPECT_EQ(find_xml_error(empty), "");
  EXPECT_THAT(empty, HasSubstr("x [m]"));
  EXPECT_THAT(empty, HasSubstr("y [m]"));
  plot.mark({1.5, 2}, LegendLine::Mark::kSquare, 5, {.fill = "#123456"});
  const std::string svg = plot.document();
  std::smatch found;
  ASSERT_TRUE(std::regex_search(svg, found, std::regex("points=\"[0-9.]+,([0-9.]+)[^>]*#123456")));
  const double top_px = std::stod(found[1]);
  ASSERT_TRUE(std::regex_search(svg, found, std::regex("y=\"([0-9.]+)\"[^>]*>corners<")));
  EXPECT_LT(std::stod(found[1]) + 3, top_px - 10) << "the last line ends above the drawing";
}

TEST(MetrePlot, LineThroughOutside_HasAGap) {
  MetrePlot plot({Vec2(0, 0), Vec2(3, 3)}, "A drive", {});
  const std::vector<Vec2> points = {{0, 0}, {1, 1}, {9, 9}, {2, 2}, {3, 3}};
  plot.polyline(points, {.stroke = "#123456"});
  const std::string svg = plot.document();
  const std::regex line("<polyline[^>]*#123456");
  EXPECT_EQ(std::distance(std::sregex_iterator(svg.begin(), svg.end(), line), {}), 2);
}

}  // namespace
}  // namespace cornerd::tool
