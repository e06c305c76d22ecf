// SPDX-License-Identifier: MIT
#include "plan/dxf_reader.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "plan/wall_pairing.hpp"
#include "settings/document.hpp"

namespace cornerd::plan {
namespace {

using core::Vec2;

/// Pairs of code and value, separated by spaces, each on two lines.
std::string section(const std::string& name, const std::string& pairs) {
  std::string text = "0 SECTION 2 " + name + " " + pairs + " 0 ENDSEC ";
  std::replace(text.begin(), text.end(), ' ', '\n');
  return text;
}

Drawing read_entities(const std::string& entities, const std::string& blocks = {},
                      const LayerChoice& layers = {}) {
  return read_dxf((blocks.empty() ? "" : section("BLOCKS", blocks)) +
                      section("ENTITIES", entities) + "0\nEOF\n",
                  layers);
}

class DxfReader : public testing::Test {
 protected:
  void SetUp() override {
    if (!has_dxf()) GTEST_SKIP() << "built without dxflib";
  }
};

constexpr const char* kLine = "0 LINE 8 walls 10 1 20 2 11 3 21 4";

TEST_F(DxfReader, Line_WithItsLayer) {
  const Drawing drawing = read_entities(kLine);
  ASSERT_EQ(drawing.lines.size(), 1U);
  EXPECT_EQ(drawing.lines[0].from, Vec2(1, 2));
  EXPECT_EQ(drawing.lines[0].to, Vec2(3, 4));
  EXPECT_EQ(drawing.layers.at("walls"), 1U);
  EXPECT_FALSE(drawing.metres_per_unit);
  EXPECT_THROW(read_entities(kLine, "", {"doors"}), PlanError);
}

TEST_F(DxfReader, InsertUnits_Millimetres) {
  const std::string header = section("HEADER", "9 $INSUNITS 70 4");
  EXPECT_EQ(read_dxf(header + section("ENTITIES", kLine), {}).metres_per_unit, 1e-3);
}

TEST_F(DxfReader, Polylines_ClosedAndWithABulge) {
  const std::string points = "10 0 20 0 10 2 20 0 42 1 10 2 20 2";
  EXPECT_EQ(read_entities("0 LWPOLYLINE 8 0 90 3 70 0 10 0 20 0 10 2 20 0 10 2 20 2").lines.size(),
            2U);
  const Drawing closed = read_entities("0 LWPOLYLINE 8 0 90 3 70 1 " + points);
  ASSERT_EQ(closed.lines.size(), 1U + 18 + 1);
  for (std::size_t i = 1; i < 19; ++i) {
    EXPECT_NEAR((closed.lines[i].to - Vec2(2, 1)).norm(), 1, 1e-9);
    EXPECT_GE(closed.lines[i].to.x(), 2 - 1e-9);  // a bulge of 1 is a half circle to the right
  }
  const Drawing old = read_entities(
      "0 POLYLINE 8 0 66 1 70 1 0 VERTEX 8 0 10 0 20 0 0 VERTEX 8 0 10 1 20 0 0 VERTEX 8 0 10 1 20 "
      "1 0 SEQEND 8 0 " +
      std::string(kLine));
  EXPECT_EQ(old.lines.size(), 4U);
}

TEST_F(DxfReader, Arc_CounterClockwise) {
  const Drawing drawing = read_entities("0 ARC 8 0 10 5 20 5 40 2 50 350 51 20");
  ASSERT_EQ(drawing.lines.size(), 3U);
  EXPECT_NEAR((drawing.lines.back().to - Vec2(5, 5)).norm(), 2, 1e-9);
  EXPECT_GT(drawing.lines.back().to.y(), 5);
}

TEST_F(DxfReader, InsertOfABlock_PlacedWithItsLayer) {
  const std::string block = "0 BLOCK 8 0 2 B 10 1 20 0 0 LINE 8 0 10 1 20 0 11 2 21 0 0 ENDBLK";
  const Drawing drawing = read_entities("0 INSERT 8 walls 2 B 10 10 20 10 41 2 42 2 50 90", block);
  ASSERT_EQ(drawing.lines.size(), 1U);
  EXPECT_LT((drawing.lines[0].from - Vec2(10, 10)).norm(), 1e-9);
  EXPECT_LT((drawing.lines[0].to - Vec2(10, 12)).norm(), 1e-9);
  EXPECT_EQ(drawing.layers.at("walls"), 1U);
}

TEST_F(DxfReader, BlockInItself_Throws) {
  EXPECT_THROW(read_entities("0 INSERT 8 0 2 B 10 0 20 0",
                             "0 BLOCK 2 B 10 0 20 0 0 INSERT 8 0 2 B 0 ENDBLK"),
               PlanError);
}

TEST_F(DxfReader, WhatIsOnPaperOrUnknown_IsCounted) {
  const Drawing drawing = read_entities(std::string(kLine) + " 67 1 0 TEXT 8 0 1 Hall " + kLine);
  EXPECT_EQ(drawing.lines.size(), 1U);
  EXPECT_EQ(drawing.ignored.at("on paper: LINE"), 1U);
  EXPECT_EQ(drawing.ignored.at("TEXT"), 1U);
}

TEST_F(DxfReader, BadInput_SaysWhat) {
  for (const char* bad : {"", "AC1032", "AutoCAD Binary DXF\r\n", "hello\nworld\n", "0\nEOF\n"}) {
    EXPECT_THROW(read_dxf(bad, {}), PlanError) << bad;
  }
  EXPECT_THROW(read_entities("0 LWPOLYLINE 8 0 90 2000000000 10 0 20 0"), PlanError);
  EXPECT_THROW(read_entities("0 LINE 8 0 10 1e300 20 0 11 0 21 0"), PlanError);
  EXPECT_THROW(read_dxf("0\nSECTION\n" + std::string(5000, 'x') + "\n", {}), PlanError);
}

TEST_F(DxfReader, Sample_HallWithCabins) {
  const Drawing drawing =
      read_dxf(settings::read_file(CORNERD_SOURCE_DIR "/tests/unit/plan/samples/hall.dxf", 1 << 20),
               {"WALLS", "CABINS"});
  ASSERT_EQ(drawing.metres_per_unit, 1e-3);
  std::vector<DrawnLine> lines = drawing.lines;
  for (DrawnLine& line : lines) line = {1e-3 * line.from, 1e-3 * line.to};
  const PairedWalls paired = pair_walls(lines, {});
  EXPECT_EQ(paired.walls.size(), paired.two_sided);
  core::FloorPlan plan;
  plan.walls = paired.walls;
  const core::WallMap map(std::move(plan));
  EXPECT_TRUE(map.is_solid({11.7, 7.75}));  // the round corner
  EXPECT_FALSE(map.is_solid({6.06, 3.5}));  // the gap of the partition
  EXPECT_TRUE(map.is_solid({1.05, 1.5}));   // a cabin's wall
  EXPECT_TRUE(map.is_solid({7.55, 6.5}));   // of one that is turned
  EXPECT_FALSE(map.is_solid({2, 1.05}));    // its door
}

}  // namespace
}  // namespace cornerd::plan
