// SPDX-License-Identifier: MIT
// The building: walls as people draw them, and the faces and corners that a lidar sees of them.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/geometry/pose2.hpp"
#include "core/map/cell_grid.hpp"

namespace cornerd::core {

/// The centre line of a solid of rectangular section, reaching half a thickness past both points.
/// Thickness 0 is a line that is seen from both sides.
struct Wall {
  Vec2 from = Vec2::Zero();
  Vec2 to = Vec2::Zero();
  double thickness_m = 0;
};

struct Room {
  std::string name;
  std::vector<Vec2> polygon;  ///< at least three points, either way round
};

/// What a map file says.
struct FloorPlan {
  std::string name;
  double thickness_m = 0;  ///< of the walls that gave none of their own
  std::vector<Wall> walls;
  std::vector<Room> rooms;
};

/// A straight piece of wall surface. The free space is on the left of the way from `from` to `to`.
struct Face {
  Vec2 from = Vec2::Zero();
  Vec2 to = Vec2::Zero();
  Vec2 direction = Vec2::Zero();  ///< unit vector from `from` to `to`
  Vec2 normal = Vec2::Zero();     ///< unit vector into the free space: rotate_left(direction)
  double offset_m = 0;            ///< normal.dot(p) of every point p on the face
  double length_m = 0;
};

/// A place where the free space changes direction: two faces meet, or a thin wall ends. "Left" and
/// "right" are as somebody sees them who stands in the opening and looks at the corner.
struct Corner {
  Vec2 position = Vec2::Zero();
  double opening_rad = 0;    ///< of the free space: pi/2 in a room's corner, 3pi/2 at a wall's edge
  double left_face_rad = 0;  ///< direction along the left face, away from the corner, map frame
  double right_face_rad = 0;  ///< the same on the right: left_face_rad + opening_rad
  bool is_convex() const { return opening_rad > kPi; }  ///< the solid sticks out
  /// Direction into the middle of the opening.
  double bisector_rad() const { return normalize_angle(left_face_rad + opening_rad / 2); }
};

/// The map as the localizer uses it. Immutable after construction; const methods may be called from
/// any thread.
class WallMap {
 public:
  /// Unites overlapping walls into one solid and finds its faces and corners.
  /// Throws std::invalid_argument where a wall has no length and no thickness, a number is not
  /// finite, or nothing is left.
  explicit WallMap(FloorPlan plan);

  const FloorPlan& plan() const { return plan_; }
  std::span<const Face> faces() const { return faces_; }
  std::span<const Corner> corners() const { return corners_; }

  Vec2 lower_left() const { return lower_left_; }
  Vec2 upper_right() const { return upper_right_; }

  /// Index into plan().rooms of the first room that holds the point.
  std::optional<std::size_t> room_at(const Vec2& point) const;

  /// True inside the solid of a wall (never for walls of thickness 0).
  bool is_solid(const Vec2& point) const;

  /// Distance to the nearest face along one ray; 0 where there is none within `max_range_m`.
  /// For tools and tests; the localizer predicts whole turns at once (turn_prediction.hpp).
  double range_along(const Vec2& origin, double angle_rad, double max_range_m) const;

  /// Which faces lie where.
  const CellGrid& face_grid() const { return face_grid_; }

  /// Of what was made from the plan.
  std::size_t memory_bytes() const;

 private:
  void index();

  FloorPlan plan_;
  std::vector<Face> faces_;
  std::vector<Corner> corners_;
  Vec2 lower_left_ = Vec2::Zero();
  Vec2 upper_right_ = Vec2::Zero();
  CellGrid face_grid_;
  CellGrid wall_grid_;  ///< of plan_.walls
  CellGrid room_grid_;  ///< of plan_.rooms
};

}  // namespace cornerd::core
