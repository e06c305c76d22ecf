// SPDX-License-Identifier: MIT
#include "settings/learned_walls.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "error_of.hpp"

namespace cornerd::settings {
namespace {

using ::testing::HasSubstr;

std::string walls_error(const std::string& text) {
  return error_of([&] { parse_learned_walls(text, "w.json"); });
}

TEST(LearnedWalls, Written_ReadsTheSame) {
  const LearnedWallsOfMap learned{std::string(64, 'a'),
                                  {{{3, 0.012, 0.01}, {0, -0.02, 0.02}}, {1e-4, 5e-5, 4e-4}},
                                  {{core::MapChange::Kind::kNewThing, 0, {2.15, -3.45}},
                                   {core::MapChange::Kind::kWallGone, 5, {0, 0}}}};
  const LearnedWallsOfMap again = parse_learned_walls(text_of(learned), "w.json");
  EXPECT_EQ(again.map_hash, learned.map_hash);
  ASSERT_EQ(again.walls.offsets.size(), 2u);
  EXPECT_EQ(again.walls.offsets[1].wall, 0u);
  EXPECT_EQ(again.walls.offsets[1].offset_m, -0.02);
  EXPECT_DOUBLE_EQ(again.walls.offsets[1].sigma_m, 0.02);
  EXPECT_EQ(again.walls.covariance_m2, learned.walls.covariance_m2);
  EXPECT_THAT(again.changes, ::testing::UnorderedElementsAreArray(learned.changes));
  EXPECT_TRUE(again.fits(6));
  EXPECT_FALSE(again.fits(5));
}

TEST(LearnedWalls, FileWithoutChanges_HasNone) {
  const auto learned = parse_learned_walls(
      R"({"format": "cornerd-walls", "map": "a", "walls": [], "covariance": []})", "w.json");
  EXPECT_TRUE(learned.changes.empty());
}

TEST(LearnedWalls, WrongFile_NamedWithPointerAndReason) {
  EXPECT_THAT(walls_error(R"({"format": "cornerd-lidar"})"), HasSubstr("/format"));
  const std::string begin = R"({"format": "cornerd-walls", "map": "a", "walls": [{"wall": 1}], )";
  EXPECT_THAT(walls_error(begin + R"("covariance": [1, 2]})"), HasSubstr("lower triangle"));
  EXPECT_THAT(walls_error(begin + R"("covariance": [0]})"), HasSubstr("positive"));
  EXPECT_THAT(walls_error(R"({"format": "cornerd-walls", "map": "a", "walls": [{"wall": 1},
                          {"wall": 1}], "covariance": [1, 0, 1]})"),
              HasSubstr("/walls/1/wall: this wall is there twice"));
  EXPECT_THAT(walls_error(begin + R"("covariance": ["1"]})"), HasSubstr("/covariance/0"));
  EXPECT_THAT(walls_error(begin + R"("covariance": [1], "more": 1})"), HasSubstr("/more"));
  EXPECT_THAT(walls_error(begin + R"("covariance": [1], "gone": [-1]})"),
              HasSubstr("/gone/0: must be a wall's number"));
  EXPECT_THAT(walls_error(begin + R"("covariance": [1], "new": [[1, 2], [1]]})"),
              HasSubstr("/new/1: must be a place"));
  EXPECT_THAT(walls_error(begin + R"("covariance": [1], "new": [[1e308, 0]]})"),
              HasSubstr("/new/0: must be a place"));
}

TEST(LearnedWalls, FileName_HasTheMapsHash) {
  EXPECT_EQ(learned_walls_name("0123456789abcdef0123"), "walls-0123456789abcdef.json");
}

}  // namespace
}  // namespace cornerd::settings
