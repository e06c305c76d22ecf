// SPDX-License-Identifier: MIT
#include "plan/svg_reader.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "plan/svg_text.hpp"
#include "plan/wall_pairing.hpp"
#include "settings/document.hpp"

namespace cornerd::plan {
namespace {

using core::Vec2;

Drawing read_body(const std::string& body, const std::string& attributes = {},
                  const LayerChoice& layers = {}) {
  return read_svg("<svg " + attributes + ">" + body + "</svg>", layers);
}

void expect_line(const DrawnLine& line, const Vec2& from, const Vec2& to) {
  EXPECT_LT((line.from - from).norm(), 1e-9) << line.from.transpose();
  EXPECT_LT((line.to - to).norm(), 1e-9) << line.to.transpose();
}

class SvgReader : public testing::Test {
 protected:
  void SetUp() override {
    if (!has_svg()) GTEST_SKIP() << "built without pugixml";
  }
};

TEST_F(SvgReader, Line_YPointsUp) {
  const Drawing drawing = read_body(R"(<line x1="1" y1="2" x2="3" y2="4"/>)");
  ASSERT_EQ(drawing.lines.size(), 1U);
  expect_line(drawing.lines[0], {1, -2}, {3, -4});
  EXPECT_FALSE(drawing.metres_per_unit);
}

TEST_F(SvgReader, SizeAndViewBox_GiveTheUnitAndTheOrigin) {
  const Drawing drawing = read_body(R"(<line x1="10" y1="25" x2="20" y2="5"/>)",
                                    R"(width="10cm" height="20cm" viewBox="10 5 10 20")");
  EXPECT_NEAR(drawing.metres_per_unit.value(), 0.01, 1e-12);
  expect_line(drawing.lines.at(0), {0, 0}, {10, 20});
  EXPECT_FALSE(read_body("", R"(width="100px" viewBox="0 0 1 1")").metres_per_unit);
}

TEST_F(SvgReader, NestedTransforms_ApplyFromTheInside) {
  const Drawing drawing = read_body(
      "<g transform='translate(10,0) rotate(90)'>"
      "<rect transform='scale(2)' width='1' height='2'/></g>");
  ASSERT_EQ(drawing.lines.size(), 4U);
  expect_line(drawing.lines[0], {10, 0}, {10, -2});
  expect_line(drawing.lines[1], {10, -2}, {6, -2});
  const Drawing about = read_body("<g transform='rotate(180 1 1)'><line x2='2'/></g>");
  expect_line(about.lines.at(0), {2, -2}, {0, -2});
}

TEST_F(SvgReader, Path_AllCommands) {
  const auto paths = parse_path("M1 1h2v2H1zm0,10l1-1.5.5.5");
  ASSERT_EQ(paths.size(), 3U);
  EXPECT_EQ(paths[0], (std::vector<Vec2>{{1, 1}, {3, 1}, {3, 3}, {1, 3}, {1, 1}}));
  EXPECT_EQ(paths[2], (std::vector<Vec2>{{1, 11}, {2, 9.5}, {2.5, 10}}));
}

TEST_F(SvgReader, PathCurves_StayOnTheirCircles) {
  for (const char* data : {"M1 0A1 1 0 0 1 0 1", "M1 0a1 1 0 0 1-1 1", "M1 0C1 .5523.5523 1 0 1",
                           "M1 0a1 1 0 01-1 1"}) {
    const auto paths = parse_path(data);
    ASSERT_EQ(paths.size(), 1U) << data;
    EXPECT_LT((paths[0].back() - Vec2(0, 1)).norm(), 1e-12);
    for (const Vec2& point : paths[0]) EXPECT_NEAR(point.norm(), 1, 3e-4) << data;
  }
  const auto large = parse_path("M1 0A1 1 0 1 1 0 1").at(0);
  for (const Vec2& point : large) EXPECT_NEAR((point - Vec2(1, 1)).norm(), 1, 1e-9);
  EXPECT_EQ(large.size(), 28U);  // 270 degrees
}

TEST_F(SvgReader, Layers_ByLabelAndId) {
  const std::string body = R"(<g inkscape:label="Walls" id="g1"><g id="inner"><line x2="1"/></g></g>
    <g id="g2"><line x2="1"/><line x2="2"/></g><g display="none"><line x2="3"/></g>)";
  EXPECT_EQ(read_body(body).lines.size(), 3U);
  EXPECT_EQ(read_body(body, "", {"Walls"}).lines.size(), 1U);
  EXPECT_EQ(read_body(body, "", {"g1"}).lines.size(), 1U);
  EXPECT_EQ(read_body(body, "", {"g2", "inner"}).lines.size(), 3U);
  try {
    read_body(body, "", {"doors"});
    FAIL();
  } catch (const PlanError& error) {
    EXPECT_STREQ(error.what(), "has no layer \"doors\"; its layers: Walls, g2, inner");
  }
}

TEST_F(SvgReader, LengthWithUnit_IsQuotedWhole) {
  for (const std::string length : {"50%", "25.5mm"}) {
    try {
      read_body("<line x2='" + length + "'/>");
      FAIL();
    } catch (const PlanError& error) {
      EXPECT_THAT(error.what(), testing::HasSubstr("in \"" + length + "\" is not a number"));
    }
  }
}

TEST_F(SvgReader, BadInput_SaysWhat) {
  EXPECT_THROW(read_svg("<svg><line", {}), PlanError);
  EXPECT_THROW(read_svg("<html/>", {}), PlanError);
  for (const char* bad :
       {"<path d='L1 1'/>", "<path d='M1'/>", "<path d='M1 1 2 2 z 3'/>", "<path d='M0 0 K1 1'/>",
        "<g transform='spin(1)'/>", "<g transform='rotate(1,2)'/>", "<line x1='1e30'/>",
        "<line x1='nan'/>", "<polyline points='1,2 x'/>"}) {
    EXPECT_THROW(read_body(bad), PlanError) << bad;
  }
  std::string deep;
  for (int i = 0; i < 1000; ++i) deep += "<g>";
  for (int i = 0; i < 1000; ++i) deep += "</g>";
  EXPECT_THROW(read_body(deep), PlanError);
}

TEST_F(SvgReader, Sample_FlatOfSolidWalls) {
  const Drawing drawing =
      read_svg(settings::read_file(CORNERD_SOURCE_DIR "/tests/unit/plan/samples/flat.svg", 1 << 20),
               {"walls"});
  std::vector<DrawnLine> lines = drawing.lines;
  for (DrawnLine& line : lines) line = {0.01 * line.from, 0.01 * line.to};
  core::FloorPlan plan;
  plan.walls = pair_walls(lines, {}).walls;
  const core::WallMap map(std::move(plan));
  EXPECT_TRUE(map.is_solid({4.26, 5}));     // an inner wall
  EXPECT_TRUE(map.is_solid({8.05, 3}));     // the outer wall
  EXPECT_FALSE(map.is_solid({4.3, 0.3}));   // its door
  EXPECT_FALSE(map.is_solid({4.26, 3.3}));  // a passage
  EXPECT_FALSE(map.is_solid({5.2, 1.2}));   // of the layer furniture
  EXPECT_NEAR(map.upper_right().x() - map.lower_left().x(), 8, 1e-6);
}

}  // namespace
}  // namespace cornerd::plan
