// SPDX-License-Identifier: MIT
#include "core/map/visible_faces.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <set>

#include "../fixtures.hpp"

namespace cornerd::core {
namespace {

/// The face that one ray hits, by testing all faces.
std::pair<std::size_t, double> nearest_face(const WallMap& map, const Vec2& origin,
                                            double angle_rad, double max_range_m) {
  const Vec2 ray = unit_vector(angle_rad);
  const double x = origin.x();
  const double y = origin.y();
  const auto faces = map.faces();
  std::pair<std::size_t, double> nearest{map.faces().size(), max_range_m};
  for (std::size_t i = 0; i < faces.size(); ++i) {
    const Face& face = faces[i];
    const double height_m = face.normal.x() * x + face.normal.y() * y - face.offset_m;
    const double approach = -face.normal.x() * ray.x() - face.normal.y() * ray.y();
    if (height_m <= 0 || approach <= 1e-12) continue;
    const double range_m = height_m / approach;
    if (range_m >= nearest.second) continue;
    const double along_m = face.direction.dot(origin + range_m * ray - face.from);
    if (along_m < 0 || along_m > face.length_m) continue;
    nearest = {i, range_m};
  }
  return nearest;
}

/// Many short walls of any direction and thickness.
FloorPlan thicket(testing::ScanSource& source, int walls, double size_m) {
  FloorPlan plan;
  for (int i = 0; i < walls; ++i) {
    const Pose2 place = source.place_in(0, size_m, 0, size_m);
    const double length_m = 0.1 + 0.3 * (i % 7);
    plan.walls.push_back({place.translation(), place * Vec2(length_m, 0), 0.02 * (i % 3)});
  }
  return plan;
}

void expect_all_seen_faces(const WallMap& map, const Vec2& origin, double max_range_m) {
  VisibleFaces visible_faces;
  std::set<std::size_t> visited;
  visible_faces.find(map, origin, max_range_m,
                     [&](std::uint32_t face, const VisibleFace&) { visited.insert(face); });
  for (int i = 0; i < 90; ++i) {
    const double angle_rad = radians(0.25 + 4 * i);
    const auto [face, range_m] = nearest_face(map, origin, angle_rad, max_range_m);
    EXPECT_NEAR(map.range_along(origin, angle_rad, max_range_m),
                face < map.faces().size() ? range_m : 0, 1e-9);
    if (face == map.faces().size()) continue;
    EXPECT_TRUE(visited.contains(face)) << face << " at " << range_m << " m";
    EXPECT_TRUE(visible_faces.occlusion().may_be_visible(range_m * unit_vector(angle_rad), 0.001));
  }
}

TEST(VisibleFaces, FaceHitByRay_IsVisited) {
  testing::ScanSource source(41);
  for (const int walls : {3, 30, 300, 900}) {
    const double size_m = walls < 100 ? 4 : 15;
    const WallMap map(thicket(source, walls, size_m));
    for (int k = 0; k < 8; ++k) {
      expect_all_seen_faces(map, source.place_in(-2, size_m + 2, -2, size_m + 2).translation(), 8);
    }
  }
}

TEST(VisibleFaces, ViewpointAlignedWithCorners_AllFacesVisited) {
  FloorPlan plan;
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j < 6; ++j) plan.walls.push_back({{i, j}, {i + 0.5, j}, 0});
    plan.walls.push_back({{i + 0.75, 0}, {i + 0.75, 6}, 0.25});
  }
  const WallMap map(plan);
  for (double x = -1; x <= 7; x += 0.5) {
    for (double y = -1; y <= 7; y += 0.5) {
      // Slightly off the lattice: on a wall's own line visibility depends on rounding.
      expect_all_seen_faces(map, {x + 1e-7, y + 2e-7}, 8);
    }
  }
}

TEST(VisibleFaces, RoomAmongManyRooms_OthersAreOccluded) {
  FloorPlan plan;
  for (int i = 0; i <= 30; ++i) {
    plan.walls.push_back({{3.0 * i, 0}, {3.0 * i, 90}, 0.1});
    plan.walls.push_back({{0, 3.0 * i}, {90, 3.0 * i}, 0.1});
  }
  const WallMap map(plan);
  VisibleFaces visible_faces;
  int visits = 0;
  visible_faces.find(map, {46.1, 47.3}, 12, [&](std::uint32_t, const VisibleFace&) { ++visits; });
  EXPECT_GE(visits, 4);
  EXPECT_LE(visits, 8);
  EXPECT_LT(visible_faces.occlusion().max_range_m(), 3);
}

TEST(VisibleFaces, ViewpointFarOutside_NothingVisited) {
  const WallMap map(testing::l_shaped_room());
  VisibleFaces visible_faces;
  for (const Vec2& place : {Vec2(1e9, 0), Vec2(-40, 2), Vec2(std::nan(""), 0)}) {
    visible_faces.find(map, place, 12, [](std::uint32_t, const VisibleFace&) {
      ADD_FAILURE() << "seen from afar";
    });
  }
}

}  // namespace
}  // namespace cornerd::core
