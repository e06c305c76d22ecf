// SPDX-License-Identifier: MIT
#include "core/estimate/face_walls.hpp"

#include <cmath>

#include "core/map/outline.hpp"

namespace cornerd::core {
namespace {

/// Cosine between a face's normal and its wall's.
constexpr double kParallel = 0.999;
constexpr double kBehind_m = 1e-4;

}  // namespace

std::vector<FaceWall> face_walls(const WallMap& map) {
  std::vector<FaceWall> sides(map.faces().size());
  for (std::size_t k = 0; k < sides.size(); ++k) {
    const Face& face = map.faces()[k];
    const Vec2 behind = (face.from + face.to) / 2 - kBehind_m * face.normal;
    for (const std::uint32_t i : map.walls_at(behind)) {
      const WallBox box(map.plan().walls[i]);
      const Vec2 local = box.to_local(behind).cwiseAbs();
      const double along = face.normal.dot(rotate_left(box.along));
      if (std::abs(along) < kParallel || local.x() > box.half_length_m + kBehind_m ||
          local.y() > box.half_width_m + 2 * kBehind_m) {
        continue;
      }
      sides[k] = {i, along > 0 ? 1.0 : -1.0};
      break;
    }
  }
  return sides;
}

}  // namespace cornerd::core
