// SPDX-License-Identifier: MIT
#include "tool/map/look_alikes.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "bench/building.hpp"
#include "tool/drawing/map_drawing.hpp"
#include "xml_check.hpp"

namespace cornerd::tool {
namespace {

using core::WallMap;
using testing::HasSubstr;

std::shared_ptr<const WallMap> make_map(core::FloorPlan plan) {
  return std::make_shared<const WallMap>(std::move(plan));
}

core::FloorPlan closed_room(double width_m, double depth_m) {
  core::FloorPlan plan;
  plan.walls = {{{0, 0}, {width_m, 0}, 0.1},
                {{width_m, 0}, {width_m, depth_m}, 0.1},
                {{width_m, depth_m}, {0, depth_m}, 0.1},
                {{0, depth_m}, {0, 0}, 0.1}};
  plan.rooms.push_back({"hall", {{0, 0}, {width_m, 0}, {width_m, depth_m}, {0, depth_m}}});
  return plan;
}

TEST(LookAlikes, RectangularRoom_MatchesItselfRotated) {
  const auto map = make_map(closed_room(3, 2));
  const auto places = examine_places(map, 60);
  EXPECT_GT(places.size(), 30U);
  for (const ExaminedPlace& place : places) {
    if (place.look_alikes.empty()) continue;
    ASSERT_EQ(place.look_alikes.size(), 1U);
    EXPECT_NEAR(std::abs(place.look_alikes[0].theta_rad), core::kPi, 0.02);
    EXPECT_NEAR(place.look_alikes[0].x_m, 3 - place.place.x_m, 0.02);
  }
  const auto alike = std::count_if(places.begin(), places.end(),
                                   [](const auto& place) { return !place.look_alikes.empty(); });
  EXPECT_GE(static_cast<std::size_t>(alike) * 10, places.size() * 9);
  EXPECT_THAT(describe_look_alikes(*map, places), HasSubstr("hall like itself, turned by 180"));
}

TEST(LookAlikes, AsymmetricRoom_HasNone) {
  core::FloorPlan plan = closed_room(3, 2);
  plan.walls.push_back({{0.9, 0}, {0.9, 0.7}, 0.1});
  const auto map = make_map(std::move(plan));
  const auto places = examine_places(map, 60);
  for (const ExaminedPlace& place : places) EXPECT_TRUE(place.is_known);
  EXPECT_THAT(describe_look_alikes(*map, places), HasSubstr("alike    0 of"));
}

TEST(LookAlikes, EqualRooms_AreNamedInPairsAndDrawn) {
  const auto map = make_map(bench::equal_rooms(4));
  const auto places = examine_places(map, 80);
  const std::string text = describe_look_alikes(*map, places);
  EXPECT_THAT(text, HasSubstr("room-2 like room-3, turned by 0 degrees"));
  MapDrawing drawing(*map);
  drawing.add_examined_places(places);
  EXPECT_EQ(find_xml_error(drawing.document("look-alikes")), "");
}

TEST(LookAlikes, MapWithoutRooms_NamesPositions) {
  core::FloorPlan plan = closed_room(3, 2);
  plan.rooms.clear();
  const auto map = make_map(std::move(plan));
  EXPECT_THAT(describe_look_alikes(*map, examine_places(map, 6)), HasSubstr(") like ("));
}

TEST(LookAlikes, MapWithoutInterior_HasNoPlaces) {
  core::FloorPlan plan;
  plan.walls.push_back({{0, 0}, {2, 0}, 0.1});
  const auto map = make_map(std::move(plan));
  const auto places = examine_places(map, 50);
  EXPECT_TRUE(places.empty());
  EXPECT_THAT(describe_look_alikes(*map, places), HasSubstr("no place examined"));
}

}  // namespace
}  // namespace cornerd::tool
