// SPDX-License-Identifier: MIT
#include "gridmap/map_server_yaml.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "gridmap/image.hpp"

namespace cornerd::gridmap {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

const std::string kRest =
    "resolution: 0.05\norigin: [-10, -8.5, 0.1]\nnegate: 0\noccupied_thresh: 0.65\n"
    "free_thresh: 0.196\n";
const std::string kWhole = "image: map.pgm\n" + kRest;

/// "/key: reason"
std::string yaml_error(const std::string& text) {
  try {
    parse_map_server_yaml(text);
  } catch (const GridError& error) {
    return error.pointer() + ": " + error.what();
  }
  return "none";
}

std::string replaced(const std::string& old, const std::string& by) {
  std::string text = kWhole;
  text.replace(text.find(old), old.size(), by);
  return text;
}

class MapServerYamlTest : public testing::Test {
 protected:
  void SetUp() override {
    if (!has_yaml()) GTEST_SKIP() << "built without libyaml-cpp";
  }
};

TEST_F(MapServerYamlTest, Parse_MapSaverOutput_GivesItsValues) {
  const MapServerYaml yaml = parse_map_server_yaml(kWhole);
  EXPECT_EQ(yaml.image, "map.pgm");
  EXPECT_EQ(yaml.resolution_m, 0.05);
  EXPECT_EQ(yaml.T_map_picture.x_m, -10);
  EXPECT_EQ(yaml.T_map_picture.y_m, -8.5);
  EXPECT_EQ(yaml.T_map_picture.theta_rad, 0.1);
  EXPECT_FALSE(yaml.negate);
  EXPECT_EQ(yaml.occupied_threshold, 0.65);
  EXPECT_EQ(yaml.free_threshold, 0.196);
  EXPECT_EQ(yaml.mode, ShadeMode::kTrinary);
  EXPECT_TRUE(yaml.unknown_keys.empty());
}

TEST_F(MapServerYamlTest, Parse_OtherNotation_GivesItsValues) {
  const MapServerYaml yaml = parse_map_server_yaml(
      "---\r\n# by hand\r\nimage: \"a #1.png\"  # quoted\r\nmode: scale\r\nresolution: +5e-2\r\n"
      "origin:\r\n- 1.0\r\n- 2\r\n- -.5\r\n\r\nnegate: true\r\noccupied_thresh: 1\r\n"
      "free_thresh: 0.0\r\nauthor: 'me'\r\n...\r\nwhatever\r\n");
  EXPECT_EQ(yaml.image, "a #1.png");
  EXPECT_EQ(yaml.resolution_m, 0.05);
  EXPECT_EQ(yaml.T_map_picture.y_m, 2);
  EXPECT_EQ(yaml.T_map_picture.theta_rad, -0.5);
  EXPECT_TRUE(yaml.negate);
  EXPECT_EQ(yaml.mode, ShadeMode::kScale);
  EXPECT_THAT(yaml.unknown_keys, ElementsAre("author"));
}

TEST_F(MapServerYamlTest, Parse_AnchorsAndEscapes_AreResolved) {
  EXPECT_EQ(parse_map_server_yaml("file: &x map.pgm\nimage: *x\n" + kRest).image, "map.pgm");
  EXPECT_EQ(parse_map_server_yaml("image: \"map\\x2epgm\"\n" + kRest).image, "map.pgm");
}

TEST_F(MapServerYamlTest, Parse_BooleansOfYaml11_AreAccepted) {
  for (const char* word : {"0", "n", "no", "No", "NO", "false", "False", "FALSE", "off"}) {
    EXPECT_FALSE(
        parse_map_server_yaml(replaced("negate: 0", "negate: " + std::string(word))).negate);
  }
  for (const char* word : {"1", "Y", "yes", "Yes", "YES", "true", "True", "TRUE", "On"}) {
    EXPECT_TRUE(
        parse_map_server_yaml(replaced("negate: 0", "negate: " + std::string(word))).negate);
  }
  EXPECT_THAT(yaml_error(replaced("negate: 0", "negate: tRUE")), HasSubstr("/negate: must be"));
}

TEST_F(MapServerYamlTest, Parse_ByteOrderMark_IsIgnored) {
  EXPECT_EQ(parse_map_server_yaml("\xEF\xBB\xBF" + kWhole).image, "map.pgm");
  EXPECT_THAT(yaml_error("\xEF\xBB" + kWhole), HasSubstr("/image: is missing"));
}

TEST_F(MapServerYamlTest, Parse_ListOfAnyShape_IsAccepted) {
  const std::string bracketed = "[-10, -8.5, 0.1]";
  for (const char* shape : {"[-10,\n         -8.5,  # y\n\n 0.1]", "\n  [-10, -8.5, 0.1]",
                            "\n  [\n -10, -8.5,\n 0.1,\n ]", "\n- -10\n- -8.5\n- 0.1",
                            "\r\n  -  -10\r\n  -\t-8.5\r\n  - 0.1"}) {
    const MapServerYaml yaml = parse_map_server_yaml(replaced(bracketed, shape));
    EXPECT_EQ(yaml.T_map_picture.x_m, -10) << shape;
    EXPECT_EQ(yaml.T_map_picture.y_m, -8.5) << shape;
    EXPECT_EQ(yaml.T_map_picture.theta_rad, 0.1) << shape;
    EXPECT_FALSE(yaml.negate);
  }
  EXPECT_THAT(yaml_error(replaced(bracketed, "[-10, -8.5, 0.1")), HasSubstr("is no YAML"));
  EXPECT_THAT(yaml_error(replaced(bracketed, "[-10,\n-8.5, 0.1] m")), HasSubstr("is no YAML"));
  EXPECT_THAT(yaml_error(replaced(bracketed, "[[-10,\n-8.5], 0.1]")),
              HasSubstr("/origin: must be a list"));
  EXPECT_THAT(yaml_error(replaced(bracketed, "[[-10], -8.5, 0.1]")),
              HasSubstr("/origin/0: must be a number"));
}

TEST_F(MapServerYamlTest, Parse_WrongValue_NamesItsKey) {
  EXPECT_THAT(yaml_error(kRest), HasSubstr("/image: is missing"));
  EXPECT_THAT(yaml_error("image: {a: 1}\n" + kRest), HasSubstr("/image: must be text"));
  EXPECT_THAT(yaml_error("image: \"a\\n\"\n" + kRest), HasSubstr("/image: must be text"));
  EXPECT_THAT(yaml_error("map:\n  image: map.pgm\n"), HasSubstr("/image: is missing"));
  EXPECT_THAT(yaml_error(kWhole + "mode: sparse\n"), HasSubstr("/mode: must be"));
  EXPECT_THAT(yaml_error(kWhole + "negate: 0\n"), HasSubstr("/negate: this key is there twice"));
  EXPECT_THAT(yaml_error(replaced("0.05", "0")), HasSubstr("/resolution: must be from"));
  EXPECT_THAT(yaml_error(replaced("0.05", ".nan")), HasSubstr("/resolution: must be a number"));
  EXPECT_THAT(yaml_error(replaced("0.05", "[1]")), HasSubstr("/resolution: must be a number"));
  EXPECT_THAT(yaml_error(replaced("0.05", "5 cm")), HasSubstr("/resolution: must be a number"));
  EXPECT_THAT(yaml_error(replaced(", 0.1]", "]")), HasSubstr("/origin: must be a list"));
  EXPECT_THAT(yaml_error(replaced("-8.5", "here")), HasSubstr("/origin/1: must be a number"));
  EXPECT_THAT(yaml_error(replaced("negate: 0", "negate: 2")), HasSubstr("/negate: must be 0 or 1"));
  EXPECT_THAT(yaml_error(replaced("0.65", "0.1")), HasSubstr("/free_thresh: must be below"));
}

TEST_F(MapServerYamlTest, Parse_BrokenYaml_NamesTheLine) {
  EXPECT_THAT(yaml_error("image: *x\n" + kRest), HasSubstr("line 1: is no YAML"));
  EXPECT_THAT(yaml_error("image:map.pgm\n" + kRest), HasSubstr("line 2: is no YAML"));
  EXPECT_THAT(yaml_error("image: map.pgm\norigin: [1,\n2, 3\n"), HasSubstr("line 4: is no YAML"));
  EXPECT_THAT(yaml_error("? [a]\n: b\n" + kWhole), HasSubstr("line 1: a key must be text"));
  EXPECT_THAT(yaml_error("- 1\n"), HasSubstr("no `key: value` lines"));
  EXPECT_THAT(yaml_error("image map.pgm\n"), HasSubstr("no `key: value` lines"));
  EXPECT_THAT(yaml_error(""), HasSubstr("no `key: value` lines"));
  EXPECT_THAT(yaml_error(std::string(60'000, '[')), HasSubstr("is no YAML"));
}

TEST(MapServerYamlWithoutLibrary, Parse_AnyText_FailsWithRemedy) {
  if (has_yaml()) GTEST_SKIP() << "built with libyaml-cpp";
  EXPECT_THAT(yaml_error(kWhole), HasSubstr("import the map on a PC"));
}

}  // namespace
}  // namespace cornerd::gridmap
