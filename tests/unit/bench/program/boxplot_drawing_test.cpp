// SPDX-License-Identifier: MIT
#include "bench/program/boxplot_drawing.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

#include "tests/unit/tool/xml_check.hpp"

namespace cornerd::bench {
namespace {

using testing::HasSubstr;

TEST(DrawBoxplots, EachSeries_HasBoxAndName) {
  const std::vector<BoxplotSeries> series = {{"one", {1, 2, 3, 4, 5}}, {"a < b", {2, 2, 2, 9}}};
  const std::string picture = draw_boxplots({"Time", "of 5", "us"}, series);
  EXPECT_EQ(tool::find_xml_error(picture), "");
  EXPECT_EQ(tool::count_elements(picture, "polygon"), 2u);
  EXPECT_EQ(tool::count_elements(picture, "circle"), 1u);  // 9 lies beyond the whiskers
  EXPECT_THAT(picture, HasSubstr("a &lt; b"));
  EXPECT_THAT(picture, HasSubstr(">Time</text>"));
}

TEST(DrawBoxplots, Median_IsAtItsHeight) {
  // The axis reaches to 1.05 of the largest value, over 340 pixels above the lower margin of 76.
  const std::vector<BoxplotSeries> series = {{"one", {0, 5, 10}}};
  const std::string picture = draw_boxplots({"T", "", "mm"}, series);
  const double median_px = 76 + 340 - 5 / 10.5 * 340;  // 254.1
  EXPECT_NEAR(median_px, 254.1, 0.01);
  EXPECT_THAT(picture, HasSubstr("119,254.1 183,254.1"));
}

TEST(DrawBoxplots, NoValues_GiveEmptyDrawing) {
  const std::vector<BoxplotSeries> series = {{"none", {}}};
  const std::string picture = draw_boxplots({"T", "", "mm"}, series);
  EXPECT_EQ(tool::find_xml_error(picture), "");
  EXPECT_EQ(tool::count_elements(picture, "polygon"), 0u);
  EXPECT_EQ(tool::find_xml_error(draw_boxplots({"T", "", "mm"}, {})), "");
}

}  // namespace
}  // namespace cornerd::bench
