// SPDX-License-Identifier: MIT
#include "bench/building.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "replay/simulator/random.hpp"

namespace cornerd::bench {
namespace {

using core::Vec2;

constexpr double kThickness_m = 0.12;
constexpr double kDoor_m = 0.9;
constexpr double kCorridor_m = 1.8;
/// Corners of a room (four of its own, four at its door, four at its cupboard), and of the
/// corridors of a small building, counted in generated maps.
constexpr double kCornersPerRoom = 12;
constexpr double kOtherCorners = 14;

/// A room in the frame of its corridor: x along the corridor from the room's left wall, y away from
/// it.
struct RoomShape {
  double width_m = 0;
  double depth_m = 0;
  double door_m = 0;  ///< where the door begins
  double cupboard_m = 0;
  double cupboard_depth_m = 0;
};

/// Draws rooms along a corridor: above it where `up` is 1, below it where `up` is -1.
class CorridorSide {
 public:
  CorridorSide(core::FloorPlan& plan, const Vec2& start, double up)
      : plan_(plan), start_(start), up_(up) {}

  void add(const RoomShape& room, std::string name) {
    wall({0, 0}, {0, room.depth_m});
    wall({0, room.depth_m}, {room.width_m, room.depth_m});
    wall({0, 0}, {room.door_m, 0});
    wall({room.door_m + kDoor_m, 0}, {room.width_m, 0});
    wall({room.cupboard_m, room.depth_m}, {room.cupboard_m, room.depth_m - room.cupboard_depth_m});
    plan_.rooms.push_back({std::move(name),
                           {at({0, 0}), at({room.width_m, 0}), at({room.width_m, room.depth_m}),
                            at({0, room.depth_m})}});
    start_.x() += room.width_m;
  }
  /// The last room's right wall.
  void close(double depth_m) { wall({0, 0}, {0, depth_m}); }
  double x_m() const { return start_.x(); }

 private:
  Vec2 at(const Vec2& point) const { return start_ + Vec2(point.x(), up_ * point.y()); }
  void wall(const Vec2& from, const Vec2& to) {
    plan_.walls.push_back({at(from), at(to), kThickness_m});
  }

  core::FloorPlan& plan_;
  Vec2 start_;
  double up_;
};

RoomShape random_room(replay::Random& random, double depth_m) {
  RoomShape room;
  room.width_m = random.uniform(2.6, 5.5);
  room.depth_m = depth_m;
  room.door_m = random.uniform(0.25, room.width_m - 0.25 - kDoor_m);
  room.cupboard_m = random.uniform(0.6, room.width_m - 0.6);
  room.cupboard_depth_m = random.uniform(0.3, 1.2);
  return room;
}

}  // namespace

core::FloorPlan office_building(std::size_t corners, std::uint64_t seed) {
  replay::Random random(seed);
  core::FloorPlan plan;
  plan.name = "offices-" + std::to_string(corners);
  plan.thickness_m = kThickness_m;
  const auto rooms = static_cast<std::size_t>(
      std::max(1L, std::lround((static_cast<double>(corners) - kOtherCorners) / kCornersPerRoom)));
  // About as wide as it is high.
  const auto rooms_per_side = static_cast<std::size_t>(
      std::ceil(std::sqrt(static_cast<double>(rooms) / 2 * (2 * 4.5 + kCorridor_m) / 4)));
  double y_m = 0;
  std::size_t done = 0;
  while (done < rooms) {
    const double below_m = random.uniform(3.2, 5.8);
    const double above_m = random.uniform(3.2, 5.8);
    const double corridor_m = y_m + below_m;
    CorridorSide below(plan, {0, corridor_m}, -1);
    CorridorSide above(plan, {0, corridor_m + kCorridor_m}, 1);
    for (std::size_t i = 0; i < rooms_per_side && done < rooms; ++i) {
      below.add(random_room(random, below_m), "room-" + std::to_string(++done));
      if (done < rooms) above.add(random_room(random, above_m), "room-" + std::to_string(++done));
    }
    below.close(below_m);
    if (above.x_m() > 0) above.close(above_m);
    // The corridor's end, past the longer side.
    const double end_m = std::max(below.x_m(), above.x_m());
    plan.walls.push_back({{below.x_m(), corridor_m}, {end_m, corridor_m}, kThickness_m});
    plan.walls.push_back(
        {{above.x_m(), corridor_m + kCorridor_m}, {end_m, corridor_m + kCorridor_m}, kThickness_m});
    plan.walls.push_back({{end_m, corridor_m}, {end_m, corridor_m + kCorridor_m}, kThickness_m});
    plan.rooms.push_back({"corridor-" + std::to_string(plan.rooms.size()),
                          {{-kCorridor_m, corridor_m},
                           {end_m, corridor_m},
                           {end_m, corridor_m + kCorridor_m},
                           {-kCorridor_m, corridor_m + kCorridor_m}}});
    y_m = corridor_m + kCorridor_m + above_m;
  }
  // The corridor along the side.
  plan.walls.push_back({{-kCorridor_m, 0}, {-kCorridor_m, y_m}, kThickness_m});
  plan.walls.push_back({{-kCorridor_m, 0}, {0, 0}, kThickness_m});
  plan.walls.push_back({{-kCorridor_m, y_m}, {0, y_m}, kThickness_m});
  plan.rooms.push_back({"side", {{-kCorridor_m, 0}, {0, 0}, {0, y_m}, {-kCorridor_m, y_m}}});
  return plan;
}

core::FloorPlan equal_rooms(std::size_t rooms) {
  core::FloorPlan plan;
  plan.name = "equal-rooms-" + std::to_string(rooms);
  plan.thickness_m = kThickness_m;
  const RoomShape room{3.5, 4, 0.6, 2.2, 0.8};
  CorridorSide side(plan, {0, kCorridor_m}, 1);
  for (std::size_t i = 0; i < rooms; ++i) side.add(room, "room-" + std::to_string(i + 1));
  side.close(room.depth_m);
  const double end_m = side.x_m();
  plan.walls.push_back({{0, 0}, {end_m, 0}, kThickness_m});
  plan.walls.push_back({{0, 0}, {0, kCorridor_m}, kThickness_m});
  plan.walls.push_back({{end_m, 0}, {end_m, kCorridor_m}, kThickness_m});
  plan.rooms.push_back({"corridor", {{0, 0}, {end_m, 0}, {end_m, kCorridor_m}, {0, kCorridor_m}}});
  return plan;
}

core::FloorPlan long_corridor(std::uint64_t seed) {
  replay::Random random(seed);
  core::FloorPlan plan;
  plan.name = "corridor";
  plan.thickness_m = kThickness_m;
  const auto add = [&](const Vec2& from, const Vec2& to) {
    plan.walls.push_back({from, to, kThickness_m});
  };
  const double length_m = random.uniform(20, 80);
  const double width_m = random.uniform(1.2, 3);
  const double longest_m = random.uniform(6, 30);
  for (const double side_m : {0.0, width_m}) {
    double x_m = 0;
    for (double gap_m = random.uniform(2, longest_m); x_m + gap_m < length_m - 1.5;
         gap_m = random.uniform(2, longest_m)) {
      const double wide_m = random.chance(0.7) ? kDoor_m : 1.2;
      const double deep_m = random.chance(0.5) ? 0.15 : random.uniform(1.5, 3);
      const double end_m = side_m + (side_m > 0 ? deep_m : -deep_m);
      add({x_m, side_m}, {x_m + gap_m, side_m});
      x_m += gap_m;
      add({x_m, side_m}, {x_m, end_m});
      add({x_m, end_m}, {x_m + wide_m, end_m});
      add({x_m + wide_m, end_m}, {x_m + wide_m, side_m});
      x_m += wide_m;
    }
    add({x_m, side_m}, {length_m, side_m});
  }
  add({0, 0}, {0, width_m});
  add({length_m, 0}, {length_m, width_m});
  return plan;
}

core::FloorPlan ring_corridor() {
  core::FloorPlan plan;
  plan.name = "ring";
  plan.thickness_m = kThickness_m;
  const auto add = [&](double x1_m, double y1_m, double x2_m, double y2_m) {
    plan.walls.push_back({{x1_m, y1_m}, {x2_m, y2_m}, kThickness_m});
  };
  const auto add_block = [&](double left_m, double low_m, double right_m, double high_m) {
    add(left_m, low_m, right_m, low_m);
    add(right_m, low_m, right_m, high_m);
    add(right_m, high_m, left_m, high_m);
    add(left_m, high_m, left_m, low_m);
  };
  add_block(0, 0, 20, 8);
  add_block(1.6, 1.6, 18.4, 6.4);
  // Pillars: of the upper side, of the left one, of the right one.
  add(4, 8, 4, 7.6);
  add(7.5, 6.4, 7.5, 6.9);
  add(10, 8, 10, 7.5);
  add(14.5, 8, 14.5, 7.7);
  add(16, 6.4, 16, 6.7);
  add(0, 3, 0.4, 3);
  add(1.6, 5.2, 1.25, 5.2);
  add(0, 6.2, 0.25, 6.2);
  add(20, 5, 19.7, 5);
  return plan;
}

}  // namespace cornerd::bench
