// SPDX-License-Identifier: MIT
#include "core/map/outline.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <stdexcept>

namespace cornerd::core {
namespace {

using ::testing::StartsWith;

std::vector<WallBox> boxes_of(const std::vector<Wall>& walls) {
  return {walls.begin(), walls.end()};
}

/// `count` walls from one point.
std::vector<Wall> fan(const Vec2& hub, int count, double thickness_m) {
  std::vector<Wall> walls;
  for (int i = 0; i < count; ++i) {
    walls.push_back({hub, hub + 5 * unit_vector(kTwoPi * i / count), thickness_m});
  }
  return walls;
}

/// Every wall of one half crosses every wall of the other.
std::vector<Wall> mesh(int count, double thickness_m) {
  std::vector<Wall> walls;
  for (int i = 0; i < count; ++i) {
    const double at_m = 0.5 * i;
    walls.push_back({{-1, at_m}, {0.5 * count, at_m}, thickness_m});
    walls.push_back({{at_m, -1}, {at_m, 0.5 * count}, thickness_m});
  }
  return walls;
}

class RandomWalls {
 public:
  explicit RandomWalls(unsigned seed) : random_(seed) {}

  /// Of both kinds: on a lattice, where many coincide, touch or continue each other, and anywhere.
  std::vector<Wall> draw() {
    std::vector<Wall> walls = fan({3, 3}, 12, thickness_m());
    for (int i = 0; i < 40; ++i) {
      const Vec2 from(0.5 * number(0, 12), 0.5 * number(0, 12));
      const Vec2 way = 0.5 * number(1, 5) * Vec2(number(-1, 1), number(-1, 1));
      if (way.norm() > 0) walls.push_back({from, from + way, thickness_m()});
    }
    for (int i = 0; i < 15; ++i) {
      const Vec2 from(share() * 6, share() * 6);
      walls.push_back({from, from + 3 * unit_vector(kTwoPi * share()), thickness_m()});
    }
    std::shuffle(walls.begin(), walls.end(), random_);
    return walls;
  }
  double share() { return std::uniform_real_distribution<>(0.01, 0.99)(random_); }

 private:
  int number(int low, int high) { return std::uniform_int_distribution<>(low, high)(random_); }
  double thickness_m() { return 0.1 * std::max(0, number(-1, 2)); }

  std::mt19937 random_;
};

bool is_in_solid(const std::vector<Wall>& walls, const Vec2& point) {
  return std::any_of(walls.begin(), walls.end(), [&](const Wall& wall) {
    const WallBox box(wall);
    const Vec2 local = box.to_local(point).cwiseAbs();
    return !box.is_line() && local.x() < box.half_length_m + 2e-6 &&
           local.y() < box.half_width_m + 2e-6;
  });
}

std::ptrdiff_t faces_at(const std::vector<Face>& faces, const Vec2& point, const Vec2& normal) {
  return std::count_if(faces.begin(), faces.end(), [&](const Face& face) {
    const double along_m = face.direction.dot(point - face.from);
    return face.normal.dot(normal) > 0.99999 && along_m > 0 && along_m < face.length_m &&
           std::abs(face.normal.dot(point) - face.offset_m) < 1e-5;
  });
}

// By definition, every point on a side of a wall has one face if it is outside of all solids, none
// otherwise: a comparison with all walls.
TEST(Outline, RandomWalls_FacesWhereNoSolidIs) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    RandomWalls random(seed);
    const std::vector<Wall> walls = random.draw();
    const std::vector<Face> faces = outline_of(boxes_of(walls));
    for (const Wall& wall : walls) {
      const WallBox box(wall);
      for (const double side : {-1.0, 1.0}) {
        for (int i = 0; i < 6; ++i) {
          const Vec2 normal = side * rotate_left(box.along);
          const Vec2 point = box.centre + (2 * random.share() - 1) * box.half_length_m * box.along +
                             box.half_width_m * normal;
          const Vec2 outside = box.is_line() ? point : point + 1e-5 * normal;
          ASSERT_EQ(faces_at(faces, point, normal), is_in_solid(walls, outside) ? 0 : 1)
              << "seed " << seed << ", (" << point.x() << ", " << point.y() << ")";
        }
      }
    }
  }
}

// In time quadratic in the walls these would take minutes.
TEST(Outline, FanOfLineWalls_AllStand) {
  constexpr int kWalls = 50'000;
  const std::vector<Face> faces = outline_of(boxes_of(fan({1, 1}, kWalls, 0)));
  EXPECT_EQ(faces.size(), 1U * kWalls);  // each continues an opposite one
  EXPECT_EQ(corners_of(faces).size(), 2U * kWalls);
}

TEST(Outline, FanOfThickWalls_IsOneDisc) {
  constexpr int kWalls = 10'000;
  const std::vector<Face> faces = outline_of(boxes_of(fan({1, 1}, kWalls, 0.1)));
  for (const Face& face : faces) EXPECT_GT((face.from - Vec2(1, 1)).norm(), 5);
}

TEST(Outline, LineWallsOnOneLine_AreOne) {
  std::vector<Wall> walls;
  for (int i = 0; i < 20'000; ++i) walls.push_back({{i * 1e-4, 0}, {5 + i * 1e-4, 0}, 0});
  EXPECT_EQ(outline_of(boxes_of(walls)).size(), 2U);
}

TEST(Outline, TooManyCrossings_AreRefused) {
  for (const double thickness_m : {0.0, 0.1}) {
    const auto load = [&] { corners_of(outline_of(boxes_of(mesh(2'000, thickness_m)))); };
    try {
      load();
      ADD_FAILURE() << thickness_m;
    } catch (const std::invalid_argument& error) {
      EXPECT_THAT(error.what(), StartsWith("too many walls cross each other"));
    }
  }
  EXPECT_EQ(corners_of(outline_of(boxes_of(mesh(100, 0)))).size(), 40'000U + 400U);
}

}  // namespace
}  // namespace cornerd::core
