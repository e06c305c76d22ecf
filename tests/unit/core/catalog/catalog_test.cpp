// SPDX-License-Identifier: MIT
#include "core/catalog/catalog.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "../fixtures.hpp"

namespace cornerd::core {
namespace {

TEST(Catalog, Pairs_AreThoseThatSeeEachOther) {
  const WallMap map(testing::two_equal_rooms());
  const Catalog catalog(map, 12);
  EXPECT_GT(catalog.pair_count(), 0U);
  for (const LandmarkPair& pair : catalog.pairs_between(0, 100)) {
    const Vec2& a = catalog.landmarks()[pair.a].position;
    const Vec2& b = catalog.landmarks()[pair.b].position;
    EXPECT_NEAR((a - b).norm(), pair.distance_m, 1e-12);
    const bool inside_a = a.x() > -0.01 && a.x() < 3.01 && a.y() > -0.01 && a.y() < 2.01;
    const bool inside_b = b.x() > 4.99 && b.x() < 8.01 && b.y() > -0.01 && b.y() < 2.01;
    EXPECT_FALSE(inside_a && inside_b) << "through the walls between the rooms";
  }
}

TEST(Catalog, PairsBetween_AreAllOfThatDistanceAndNoOthers) {
  const WallMap map(testing::l_shaped_room());
  const Catalog catalog(map, 12);
  const auto all = catalog.pairs_between(0, 100);
  EXPECT_EQ(all.size(), catalog.pair_count());
  for (double low = -0.5; low < 6; low += 0.037) {
    const double high = low + 0.2;
    const auto some = catalog.pairs_between(low, high);
    const auto expected = std::count_if(all.begin(), all.end(), [&](const LandmarkPair& pair) {
      return pair.distance_m >= low && pair.distance_m <= high;
    });
    EXPECT_EQ(static_cast<std::ptrdiff_t>(some.size()), expected);
    for (const LandmarkPair& pair : some) {
      EXPECT_GE(pair.distance_m, low);
      EXPECT_LE(pair.distance_m, high);
    }
  }
  EXPECT_TRUE(catalog.pairs_between(50, 60).empty());
}

TEST(Catalog, VisitNear_MissesNoLandmarkWithinItsRadius) {
  const WallMap map(testing::l_shaped_room());
  const Catalog catalog(map, 12);
  testing::TurnSource source(31);
  for (int k = 0; k < 2000; ++k) {
    const Vec2 point = source.place_in(-1, 5, -1, 4).translation();
    std::vector<std::uint32_t> visited;
    catalog.visit_near(point, [&](std::uint32_t index) { visited.push_back(index); });
    for (std::uint32_t i = 0; i < catalog.landmarks().size(); ++i) {
      if ((catalog.landmarks()[i].position - point).norm() > Catalog::kVisitRadius_m) continue;
      EXPECT_NE(std::find(visited.begin(), visited.end(), i), visited.end());
    }
  }
}

}  // namespace
}  // namespace cornerd::core
