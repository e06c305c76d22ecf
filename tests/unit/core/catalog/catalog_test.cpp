// SPDX-License-Identifier: MIT
#include "core/catalog/catalog.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "../fixtures.hpp"

namespace cornerd::core {
namespace {

TEST(Catalog, Pairs_AreMutuallyVisible) {
  const WallMap map(testing::two_equal_rooms());
  const Catalog catalog(map, 12);
  EXPECT_GT(catalog.pairs().size(), 0U);
  std::size_t listed = 0;
  for (std::uint32_t i = 0; i < catalog.landmarks().size(); ++i) {
    double last_m = 0;
    for (const LandmarkPair& pair : catalog.neighbours(i)) {
      ++listed;
      EXPECT_EQ(pair.from, i);
      EXPECT_GE(pair.distance_m, last_m);
      last_m = pair.distance_m;
      const Vec2& a = catalog.landmarks()[pair.from].position;
      const Vec2& b = catalog.landmarks()[pair.to].position;
      EXPECT_NEAR((a - b).norm(), pair.distance_m, 1e-5);
      const bool inside_a = a.x() > -0.01 && a.x() < 3.01 && a.y() > -0.01 && a.y() < 2.01;
      const bool inside_b = b.x() > 4.99 && b.x() < 8.01 && b.y() > -0.01 && b.y() < 2.01;
      EXPECT_FALSE(inside_a && inside_b) << "through the walls between the rooms";
    }
  }
  EXPECT_EQ(listed, 2 * catalog.pairs().size());
}

TEST(Catalog, Neighbours_MatchRayCasting) {
  testing::ScanSource source(32);
  FloorPlan plan;
  for (int i = 0; i < 60; ++i) {
    const Pose2 place = source.place_in(0, 9, 0, 9);
    plan.walls.push_back({place.translation(), place * Vec2(0.4, 0), 0.1});
  }
  const WallMap map(plan);
  const double max_distance_m = 2.5;
  const Catalog catalog(map, max_distance_m);
  const auto free_place = [](const Corner& corner) {
    return Vec2(corner.position + 1e-3 * unit_vector(corner.bisector_rad()));
  };
  for (std::uint32_t i = 0; i < catalog.landmarks().size(); ++i) {
    const auto neighbours = catalog.neighbours(i);
    const Vec2 from = free_place(catalog.landmarks()[i]);
    for (std::uint32_t j = 0; j < catalog.landmarks().size(); ++j) {
      const Vec2 way = free_place(catalog.landmarks()[j]) - from;
      const double distance_m =
          (catalog.landmarks()[j].position - catalog.landmarks()[i].position).norm();
      if (i == j || std::abs(distance_m - max_distance_m) < 0.01) continue;
      const bool sees = distance_m < max_distance_m &&
                        map.range_along(from, std::atan2(way.y(), way.x()), way.norm()) == 0;
      const bool listed = std::any_of(neighbours.begin(), neighbours.end(),
                                      [&](const LandmarkPair& pair) { return pair.to == j; });
      if (sees) {
        EXPECT_TRUE(listed) << i << " and " << j;
      } else if (distance_m > max_distance_m) {
        EXPECT_FALSE(listed) << i << " and " << j;
      }
    }
  }
}

TEST(Catalog, HallOfColumns_KeepsNearestNeighbours) {
  FloorPlan plan;
  for (int i = 0; i < 12; ++i) {
    for (int j = 0; j < 12; ++j) plan.walls.push_back({{i, j}, {i, j}, 0.02});
  }
  const WallMap map(plan);
  const Catalog catalog(map, 12);
  EXPECT_LE(catalog.pairs().size(), catalog.landmarks().size() * Catalog::kMaxNeighbours);
  for (std::uint32_t i = 0; i < catalog.landmarks().size(); ++i) {
    ASSERT_GE(catalog.neighbours(i).size(), Catalog::kMaxNeighbours);
    EXPECT_LT(catalog.neighbours(i).front().distance_m, 0.03);
  }
}

// In time quadratic in the walls this would take minutes.
TEST(Catalog, FanOfWalls_HasFewLandmarksInOnePlace) {
  constexpr int kWalls = 4'000;
  FloorPlan plan;
  for (int i = 0; i < kWalls; ++i) {
    plan.walls.push_back({{0, 0}, 5 * unit_vector(kTwoPi * i / kWalls), 0});
  }
  const Catalog catalog(WallMap(std::move(plan)), 12);
  const auto in_the_middle =
      std::count_if(catalog.landmarks().begin(), catalog.landmarks().end(),
                    [](const Corner& landmark) { return landmark.position.norm() < 1; });
  EXPECT_LE(in_the_middle, 4 * static_cast<std::ptrdiff_t>(Catalog::kMaxCrowded));
  EXPECT_GT(catalog.landmarks().size(), 3'000U);  // the walls' ends
}

TEST(Catalog, VisitNear_VisitsAllWithinRadius) {
  const WallMap map(testing::l_shaped_room());
  const Catalog catalog(map, 12);
  testing::ScanSource source(31);
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
