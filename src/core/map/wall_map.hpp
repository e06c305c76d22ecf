// SPDX-License-Identifier: MIT
// The building: drawn walls, and the faces and corners that a lidar sees of them.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/geometry/pose2.hpp"
#include "core/map/cell_grid.hpp"

namespace cornerd::core {

/// The centre line of a solid of rectangular section that reaches half a thickness past both
/// points. Thickness 0 is a line visible from both sides.
struct Wall {
  Vec2 from = Vec2::Zero();
  Vec2 to = Vec2::Zero();
  double thickness_m = 0;
  /// How far off it may be across itself (a standard deviation), if that is known of this wall.
  std::optional<double> sigma_m{};
  /// `from` and `to`: the wall goes on where nobody has seen it, so its end is no corner.
  std::array<bool, 2> is_open{};
};

struct Room {
  std::string name;
  std::vector<Vec2> polygon;  ///< at least three points, in either orientation
};

/// Contents of a map file.
struct FloorPlan {
  static constexpr double kMeasuredSigma_m = 0.01;
  /// The map says that its walls are off by more than those of most maps.
  bool is_inexact() const { return sigma_m > kMeasuredSigma_m; }

  std::string name;
  double thickness_m = 0;  ///< of the walls without one of their own
  std::vector<Wall> walls;
  std::vector<Room> rooms;
  /// How far off a wall may be across itself (a standard deviation); the more, the likelier too
  /// that one is missing or was never there. Default: measured with a tape.
  double sigma_m = kMeasuredSigma_m;
  std::string hash{};  ///< SHA-256 of the file in hexadecimal; empty if the plan is from none
};

/// A straight piece of wall surface. The free space is on the left of the direction from `from` to
/// `to`.
struct Face {
  Vec2 from = Vec2::Zero();
  Vec2 to = Vec2::Zero();
  Vec2 direction = Vec2::Zero();  ///< unit vector from `from` to `to`
  Vec2 normal = Vec2::Zero();     ///< unit vector into the free space: rotate_left(direction)
  double offset_m = 0;            ///< normal.dot(p) of every point p on the face
  double length_m = 0;
  double sigma_m = 0;  ///< of its wall's own offset; 0 where the wall has none of its own
};

/// A vertex of the free space: two faces meet, or a thin wall ends. "Left" and "right" as seen from
/// the opening, facing the corner.
struct Corner {
  Vec2 position = Vec2::Zero();
  double opening_rad = 0;  ///< of the free space: pi/2 in a room's corner, 3 pi/2 at a wall's edge
  double left_face_rad = 0;   ///< direction along the left face, away from the corner, map frame
  double right_face_rad = 0;  ///< the same on the right: left_face_rad + opening_rad
  bool is_convex() const { return opening_rad > kPi; }  ///< the solid protrudes
  /// Direction into the middle of the opening.
  double bisector_rad() const { return normalize_angle(left_face_rad + opening_rad / 2); }
};

/// The map as the localizer uses it. Immutable; const methods are safe from any thread.
class WallMap {
 public:
  /// Unites overlapping walls into one solid and finds its faces and corners. Throws
  /// std::invalid_argument where a wall has neither length nor thickness, a number is not finite,
  /// or no face is left.
  explicit WallMap(FloorPlan plan);

  const FloorPlan& plan() const { return plan_; }
  std::span<const Face> faces() const { return faces_; }
  /// Without those at the open ends of walls.
  std::span<const Corner> corners() const { return corners_; }

  Vec2 lower_left() const { return lower_left_; }
  Vec2 upper_right() const { return upper_right_; }

  /// Index into plan().rooms of the first room that contains the point.
  std::optional<std::size_t> room_at(const Vec2& point) const;

  /// True inside a wall's solid (never for walls of thickness 0).
  bool is_solid(const Vec2& point) const;

  /// Distance to the nearest face along one ray; 0 where there is none within `max_range_m`. For
  /// tools and tests; the localizer casts whole scans (ray_caster.hpp).
  double range_along(const Vec2& origin, double angle_rad, double max_range_m) const;

  /// Indices into plan().walls of those that may contain the point, and few others.
  std::span<const std::uint32_t> walls_at(const Vec2& point) const { return wall_grid_.at(point); }

  /// Index of the faces by position.
  const CellGrid& face_grid() const { return face_grid_; }

  /// Of the derived data, without the plan.
  std::size_t memory_bytes() const;

 private:
  void index();
  void assign_sigmas();
  void remove_open_ends();

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
