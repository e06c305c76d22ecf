// SPDX-License-Identifier: MIT
#include "tool/drawing/svg.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>

#include "xml_check.hpp"

namespace cornerd::tool {
namespace {

using core::Vec2;
using testing::HasSubstr;

Svg two_by_one_metres() { return Svg({0, 0}, {2, 1}, 100, 10); }

TEST(XmlCheck, MalformedDocuments_AreRejected) {
  EXPECT_EQ(find_xml_error("<svg a=\"1\"><g>text &amp; more</g><line/></svg>"), "");
  EXPECT_NE(find_xml_error("<svg><g></svg>"), "");
  EXPECT_NE(find_xml_error("<svg><g></svg></g>"), "");
  EXPECT_NE(find_xml_error("<svg>a & b</svg>"), "");
  EXPECT_NE(find_xml_error("<svg a=1></svg>"), "");
  EXPECT_NE(find_xml_error("<svg/><svg/>"), "");
}

TEST(Svg, EveryKindOfShape_IsWellFormed) {
  Svg svg = two_by_one_metres();
  const std::array<Vec2, 3> triangle = {Vec2(0, 0), Vec2(1, 0), Vec2(0, 1)};
  svg.begin_group("all <of> them");
  svg.polygon(triangle, {.fill = "#123456", .stroke = "#000000", .opacity = 0.5});
  svg.polyline(triangle, {.stroke = "#000000", .dashes = "4 2"});
  svg.polyline({}, {.stroke = "#000000"});
  svg.line({0, 0}, {1, 1}, {.stroke = "#000000"});
  svg.dot({1, 1}, 3, {.fill = "#000000"});
  svg.ellipse({1, 1}, 0.2, 0.1, 1, {.fill = "#000000"});
  svg.text({1, 1}, "\"a\" < 'b' & c\x01", {.bold = true});
  svg.end_group();
  EXPECT_EQ(find_xml_error(svg.document("R&D")), "");
}

TEST(Svg, Page_HasRectangleAndMargin) {
  EXPECT_THAT(two_by_one_metres().document("t"),
              HasSubstr(R"(width="220" height="120" viewBox="0 0 220 120")"));
}

TEST(Svg, Metres_IncreaseUpwardsAndToTheRight) {
  Svg svg = two_by_one_metres();
  svg.line({0, 0}, {2, 1}, {.stroke = "#000000"});
  EXPECT_THAT(svg.document("t"), HasSubstr(R"(points="10,110 210,10")"));
}

TEST(Svg, Numbers_AreRoundedToHundredths) {
  Svg svg = two_by_one_metres();
  svg.dot({1.0 / 3, 0}, 1, {.fill = "#000000"});
  EXPECT_THAT(svg.document("t"), HasSubstr(R"(cx="43.33" cy="110")"));
}

TEST(Svg, CounterClockwiseRotation_IsNegativeOnThePage) {
  Svg svg = two_by_one_metres();
  svg.ellipse({0, 0}, 0.2, 0.1, core::radians(30), {.fill = "#000000"});
  EXPECT_THAT(svg.document("t"), HasSubstr("translate(10 110) rotate(-30)"));
}

TEST(EscapeXml, SpecialCharacters_BecomeEntities) {
  EXPECT_EQ(escape_xml("<a & \"b\" 'c'>"), "&lt;a &amp; &quot;b&quot; &#39;c&#39;&gt;");
}

TEST(EscapeXml, ControlCharacters_BecomeReplacements) {
  EXPECT_EQ(escape_xml("\x1f"), "\xEF\xBF\xBD");
  EXPECT_EQ(escape_xml(std::string_view("\0", 1)), "\xEF\xBF\xBD");
  EXPECT_EQ(escape_xml("a\tb"), "a\tb");
}

}  // namespace
}  // namespace cornerd::tool
