// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/breakpoint/breakpoint.hpp"
#include "core/estimate/wall_offset_filter.hpp"
#include "core/geometry/pose2.hpp"
#include "core/map/wall_map.hpp"
#include "core/scan.hpp"
#include "tool/drawing/svg.hpp"

namespace cornerd::tool {

/// A place, and the poses that one scan cannot distinguish from it.
struct ExaminedPlace {
  core::Pose2 place;
  bool is_known = false;                 ///< a scan there gives a fix
  bool is_lost = false;                  ///< a scan there shows too little
  std::vector<core::Pose2> look_alikes;  ///< without the place itself; empty if it is known
};

/// A map to scale with scans, poses and paths. Later elements lie above earlier ones.
class MapDrawing {
 public:
  /// Draws the grid, the rooms with their names, the walls and their corners.
  explicit MapDrawing(const core::WallMap& map);

  /// A path in the map. `truth`: thin and dashed.
  void add_path(std::span<const core::Vec2> points, bool truth = false);
  /// The same in a colour of one's own.
  void add_track(std::span<const core::Vec2> points, std::string_view colour);
  /// A line of the legend, under the picture.
  void add_legend(std::string_view text, std::string_view colour);
  /// The returns of one scan.
  void add_scan(const core::Scan& scan, const core::Pose2& T_map_lidar);
  /// Returns of a whole drive, on the map.
  void add_points(std::span<const core::Vec2> points);
  /// `wall`: where it was learned to be, with its offset in millimetres.
  void add_learned_wall(const core::Wall& wall, const core::WallOffset& offset);
  /// A ring where something stays that the map lacks.
  void add_new_thing(const core::Vec2& place) { add_closed(place, 0); }
  /// A piece of wall without observations.
  void add_thin(const core::Vec2& from, const core::Vec2& to);
  /// A cross where an import left something out; a ring where it closed a gap of this width.
  void add_left_out(const core::Vec2& place);
  void add_closed(const core::Vec2& place, double width_m);
  /// Corners as rings, terminals as squares.
  void add_breakpoints(std::span<const core::Breakpoint> breakpoints,
                       const core::Pose2& T_map_lidar);
  /// The robot as an arrowhead.
  void add_pose(const core::Pose2& T_map_base);
  /// The ellipse that holds the true position 95 times of 100.
  void add_uncertainty(const core::Pose2& T_map_base, const core::Covariance3& covariance);

  /// Known and ambiguous places, with lines to their look-alikes.
  void add_examined_places(std::span<const ExaminedPlace> places);

  /// Size of a pixel in the map.
  double pixel_m() const { return 1 / svg_.pixels_per_m(); }

  /// The whole picture. `subtitle`: one line under the map's name.
  std::string document(std::string_view subtitle);

 private:
  void draw_grid(double step_m);
  void draw_rooms();
  void draw_room_names();
  void draw_walls();
  void draw_corners();
  void draw_scale_bar(double length_m);

  const core::WallMap& map_;
  Svg svg_;
  int legends_ = 0;
};

}  // namespace cornerd::tool
