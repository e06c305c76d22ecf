// SPDX-License-Identifier: MIT
#include "bench/partitioned_flat.hpp"

#include <cmath>
#include <string>
#include <utility>

#include "replay/simulator/random.hpp"

namespace cornerd::bench {
namespace {

using core::Vec2;

struct Rectangle {
  Vec2 low;
  Vec2 high;
};

class Partition {
 public:
  Partition(std::uint64_t seed, bool is_plain) : random_(seed), is_plain_(is_plain) {
    const Rectangle outline{{0, 0},
                            {on_grid(random_.uniform(5, 18)), on_grid(random_.uniform(5, 14))}};
    plan_.name = "flat-" + std::to_string(seed);
    plan_.thickness_m = random_.uniform(0.05, 0.2);
    box(outline);
    split(outline, static_cast<int>(random_.uniform(2, 5)));
  }
  core::FloorPlan take() { return std::move(plan_); }

 private:
  double on_grid(double way_m) const {
    constexpr double kGrid_m = 0.25;
    return is_plain_ ? kGrid_m * std::round(way_m / kGrid_m) : way_m;
  }

  void wall(const Vec2& from, const Vec2& to) {
    plan_.walls.push_back({from, to, plan_.thickness_m});
  }

  void wall_with_door(const Vec2& from, const Vec2& to) {
    constexpr double kShortestWithDoor_m = 1.4;
    constexpr double kJamb_m = 0.15;
    const double length_m = (to - from).norm();
    if (length_m < kShortestWithDoor_m) return wall(from, to);
    const Vec2 direction = (to - from) / length_m;
    constexpr double kPlainDoor_m = 0.9;
    const double door_m = is_plain_ ? kPlainDoor_m : random_.uniform(0.7, 1.1);
    const double begin_m = random_.uniform(kJamb_m, length_m - door_m - kJamb_m);
    wall(from, from + begin_m * direction);
    wall(from + (begin_m + door_m) * direction, to);
  }

  void box(const Rectangle& r) {
    wall(r.low, {r.high.x(), r.low.y()});
    wall({r.high.x(), r.low.y()}, r.high);
    wall(r.high, {r.low.x(), r.high.y()});
    wall({r.low.x(), r.high.y()}, r.low);
  }

  /// Against one of the room's walls.
  void cupboard(const Rectangle& room) {
    const bool along_x = random_.chance(0.5);
    const int axis = along_x ? 0 : 1;
    Rectangle r = room;
    const double length_m = random_.uniform(0.4, 1.6);
    r.low[axis] = random_.uniform(room.low[axis], room.high[axis] - length_m);
    r.high[axis] = r.low[axis] + length_m;
    const double depth_m = random_.uniform(0.3, 0.8);
    if (random_.chance(0.5)) {
      r.high[1 - axis] = room.low[1 - axis] + depth_m;
    } else {
      r.low[1 - axis] = room.high[1 - axis] - depth_m;
    }
    box(r);
  }

  void split(const Rectangle& area, int depth) {
    constexpr double kSmall_m = 3.5;
    const Vec2 size = area.high - area.low;
    const bool is_small = size.maxCoeff() < kSmall_m;
    if (depth <= 0 || is_small || (depth < 3 && random_.chance(0.2))) return furnish(area);
    const int axis = size.x() > size.y() ? 0 : 1;
    const double at_m = on_grid(area.low[axis] + random_.uniform(0.35, 0.65) * size[axis]);
    Rectangle first = area;
    Rectangle second = area;
    first.high[axis] = second.low[axis] = at_m;
    wall_with_door(second.low, first.high);
    split(first, depth - 1);
    split(second, depth - 1);
  }

  void furnish(const Rectangle& room) {
    plan_.rooms.push_back(
        {"room-" + std::to_string(plan_.rooms.size() + 1),
         {room.low, {room.high.x(), room.low.y()}, room.high, {room.low.x(), room.high.y()}}});
    for (auto count = static_cast<int>(random_.uniform(0, is_plain_ ? 1.4 : 3)); count > 0; --count)
      cupboard(room);
    if (random_.chance(0.15)) {
      const double cut_m = random_.uniform(0.5, 1);
      wall(room.low + Vec2(0, cut_m), room.low + Vec2(cut_m, 0));
    }
  }

  replay::Random random_;
  bool is_plain_;
  core::FloorPlan plan_;
};

}  // namespace

core::FloorPlan partitioned_flat(std::uint64_t seed) { return Partition(seed, false).take(); }
core::FloorPlan plain_flat(std::uint64_t seed) { return Partition(seed, true).take(); }

}  // namespace cornerd::bench
