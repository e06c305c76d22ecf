// SPDX-License-Identifier: MIT
#include "core/map/cell_grid.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace cornerd::core {
namespace {

std::vector<Extent> random_segments(std::mt19937_64& random, std::size_t count, double size_m) {
  std::uniform_real_distribution<double> anywhere(-size_m, size_m);
  std::vector<Extent> extents;
  for (std::size_t i = 0; i < count; ++i) {
    extents.push_back(Extent::of_segment({anywhere(random), anywhere(random)},
                                         {anywhere(random), anywhere(random)}, 0.01));
  }
  return extents;
}

bool holds(std::span<const std::uint32_t> things, std::uint32_t thing) {
  return std::find(things.begin(), things.end(), thing) != things.end();
}

TEST(CellGrid, PointOfSegment_CellContainsSegment) {
  std::mt19937_64 random(5);
  for (int k = 0; k < 20; ++k) {
    std::uniform_real_distribution<double> anywhere(-7, 7);
    std::vector<Extent> extents;
    std::vector<std::pair<Vec2, Vec2>> ends;
    for (int i = 0; i < 60; ++i) {
      ends.push_back({{anywhere(random), anywhere(random)}, {anywhere(random), anywhere(random)}});
      if (i % 4 == 0) ends.back().second.x() = ends.back().first.x();
      if (i % 4 == 1) ends.back().second.y() = ends.back().first.y();
      extents.push_back(Extent::of_segment(ends.back().first, ends.back().second, 0));
    }
    const CellGrid grid(extents);
    EXPECT_GT(grid.columns() * grid.rows(), 20U);
    for (std::uint32_t i = 0; i < ends.size(); ++i) {
      for (double share = 0; share <= 1; share += 0.01) {
        const Vec2 point = ends[i].first + share * (ends[i].second - ends[i].first);
        ASSERT_TRUE(holds(grid.at(point), i)) << i << " at " << share;
      }
    }
  }
}

TEST(CellGrid, LongItems_MemoryIsBounded) {
  std::mt19937_64 random(6);
  const auto extents = random_segments(random, 20'000, 10'000);
  const CellGrid grid(extents);
  EXPECT_LT(grid.memory_bytes(), 20'000U * 32 * 4);
}

TEST(CellGrid, DistantItems_MemoryIsBounded) {
  const std::vector<Extent> extents = {
      Extent::of_segment({-10'000, -10'000}, {-9'999, -10'000}, 0.1),
      Extent::of_segment({10'000, 10'000}, {9'999, 10'000}, 0.1),
      Extent::of_segment({10'000, -10'000}, {10'000, -10'000}, 0.1)};
  const CellGrid grid(extents);
  EXPECT_LT(grid.columns() * grid.rows(), 200U);
  EXPECT_TRUE(holds(grid.at({9'999.5, 10'000}), 1));
  EXPECT_TRUE(grid.at({20'000, 0}).empty());
}

TEST(CellGrid, Collect_FindsTouchingItems) {
  const std::vector<Extent> extents = {Extent::of_segment({0, 0}, {4, 0}, 0.1),
                                       Extent::of_segment({2, -1}, {2, 1}, 0.1),
                                       Extent::of_segment({9, 9}, {9, 5}, 0.1)};
  const CellGrid grid(extents);
  std::vector<std::uint32_t> found = {7};
  grid.collect(extents[0], found);
  EXPECT_TRUE(holds(found, 0));
  EXPECT_TRUE(holds(found, 1));
  EXPECT_TRUE(std::is_sorted(found.begin(), found.end()));
  EXPECT_EQ(std::adjacent_find(found.begin(), found.end()), found.end());
}

TEST(CellGrid, NoItems_IsEmpty) {
  const CellGrid grid;
  std::vector<std::uint32_t> found = {7};
  grid.collect(Extent{}, found);
  EXPECT_TRUE(found.empty());
  EXPECT_TRUE(grid.at({0, 0}).empty());
  grid.walk({0, 0}, {1, 0}, 10, [](auto, double) {
    ADD_FAILURE() << "there is no cell";
    return true;
  });
}

}  // namespace
}  // namespace cornerd::core
