// SPDX-License-Identifier: MIT
#include "gridmap/occupancy_grid.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

namespace cornerd::gridmap {
namespace {

using testing::ElementsAre;

constexpr Cell kFree = Cell::kFree;
constexpr Cell kOccupied = Cell::kOccupied;
constexpr Cell kUnknown = Cell::kUnknown;

MapServerYaml yaml(ShadeMode mode, bool negate = false) {
  MapServerYaml yaml;
  yaml.mode = mode;
  yaml.negate = negate;
  yaml.occupied_threshold = 0.65;
  yaml.free_threshold = 0.196;
  return yaml;
}

std::vector<Cell> read(const std::vector<std::uint16_t>& shades, const MapServerYaml& how) {
  Image image;
  image.width = shades.size();
  image.height = 1;
  image.shades = shades;
  const OccupancyGrid grid = read_shades(image, how);
  std::vector<Cell> cells;
  for (std::int64_t i = 0; i < grid.columns(); ++i) cells.push_back(grid.at(i, 0));
  return cells;
}

TEST(ReadShades, SavedByMapSaver_UnknownWhateverTheThreshold) {
  MapServerYaml nav2 = yaml(ShadeMode::kTrinary);
  nav2.free_threshold = 0.25;
  EXPECT_THAT(read({0, 205, 254}, nav2), ElementsAre(kOccupied, kUnknown, kFree));
  EXPECT_THAT(read({0, 205, 255, 254}, nav2), ElementsAre(kOccupied, kUnknown, kFree, kFree));
  EXPECT_THAT(read({0, 205, 255}, nav2), ElementsAre(kOccupied, kFree, kFree));
  EXPECT_THAT(read({0, 205, 230, 254}, nav2), ElementsAre(kOccupied, kFree, kFree, kFree));
}

TEST(ReadShades, Trinary_IsUnknownBetweenThresholds) {
  EXPECT_THAT(read({0, 80, 100, 205, 206, 254}, yaml(ShadeMode::kTrinary)),
              ElementsAre(kOccupied, kOccupied, kUnknown, kUnknown, kFree, kFree));
}

TEST(ReadShades, TrinaryWithManyShades_UsesNearerStateAndKeepsUnknown) {
  const std::vector<std::uint16_t> shades = {20,  90,  100, 110, 120, 160, 170, 180, 190, 205,
                                             205, 205, 205, 205, 205, 205, 205, 205, 250};
  const std::vector<Cell> cells = read(shades, yaml(ShadeMode::kTrinary));
  EXPECT_EQ(cells[2], kOccupied);
  EXPECT_EQ(cells[4], kOccupied);
  EXPECT_EQ(cells[5], kFree);
  EXPECT_EQ(cells[10], kUnknown);
  EXPECT_EQ(cells.back(), kFree);
}

TEST(ReadShades, Negated_HasWhiteOccupied) {
  EXPECT_THAT(read({0, 50, 255}, yaml(ShadeMode::kTrinary, true)),
              ElementsAre(kFree, kUnknown, kOccupied));
}

TEST(ReadShades, Scale_UsesNearerState) {
  EXPECT_THAT(read({0, 120, 160, 255}, yaml(ShadeMode::kScale)),
              ElementsAre(kOccupied, kOccupied, kFree, kFree));
}

TEST(ReadShades, Raw_IsPerCent) {
  EXPECT_THAT(read({0, 19, 50, 66, 100, 101, 255}, yaml(ShadeMode::kRaw)),
              ElementsAre(kFree, kFree, kUnknown, kOccupied, kOccupied, kUnknown, kUnknown));
}

TEST(ReadShades, LargestValue_IsWhite) {
  Image image;
  image.width = 2;
  image.height = 1;
  image.white = 1000;
  image.shades = {1000, 255};
  const OccupancyGrid grid = read_shades(image, yaml(ShadeMode::kTrinary));
  EXPECT_EQ(grid.at(0, 0), kFree);
  EXPECT_EQ(grid.at(1, 0), kOccupied);
}

TEST(ReadShades, TopOfPicture_IsHighestRow) {
  Image image;
  image.width = 1;
  image.height = 2;
  image.shades = {0, 255};
  const OccupancyGrid grid = read_shades(image, yaml(ShadeMode::kTrinary));
  EXPECT_EQ(grid.at(0, 1), kOccupied);
  EXPECT_EQ(grid.at(0, 0), kFree);
}

TEST(ReadShades, TransparentPixels_AreUnknown) {
  Image image;
  image.width = 2;
  image.height = 1;
  image.shades = {0, 0};
  image.alphas = {255, 0};
  const OccupancyGrid grid = read_shades(image, yaml(ShadeMode::kTrinary));
  EXPECT_EQ(grid.at(0, 0), kOccupied);
  EXPECT_EQ(grid.at(1, 0), kUnknown);
}

TEST(OccupancyGrid, OutsidePicture_IsUnknown) {
  const OccupancyGrid grid = read_shades({.width = 1, .height = 1, .shades = {255}, .alphas = {}},
                                         yaml(ShadeMode::kTrinary));
  EXPECT_EQ(grid.at(0, 0), kFree);
  EXPECT_EQ(grid.at(-1, 0), kUnknown);
  EXPECT_EQ(grid.at(core::Vec2(0.5, 1.5)), kUnknown);
}

}  // namespace
}  // namespace cornerd::gridmap
