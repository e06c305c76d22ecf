// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/breakpoint/breakpoint.hpp"
#include "core/geometry/pose2.hpp"
#include "core/map/wall_map.hpp"
#include "core/scan.hpp"
#include "tool/drawing/svg.hpp"

namespace cornerd::tool {

/// A place of a building, and the others that one scan cannot tell from it.
struct ExaminedPlace {
  core::Pose2 place;
  bool is_known = false;                 ///< a scan taken there names it
  bool is_lost = false;                  ///< or it fits nowhere: too little is seen from there
  std::vector<core::Pose2> look_alikes;  ///< without the place itself; none where it is known
};

/// A map to scale, and on it what a lidar saw and where the robot was. Draw from the bottom up:
/// what is added later lies above.
class MapDrawing {
 public:
  /// Draws the grid, the rooms with their names, the walls and their corners.
  explicit MapDrawing(const core::WallMap& map);

  /// A way through the map. `truth`: thin and dashed, for the one that is only compared with.
  void add_path(std::span<const core::Vec2> points, bool truth = false);
  /// The same in a colour of one's own.
  void add_track(std::span<const core::Vec2> points, std::string_view colour);
  /// A line of the legend, under the picture.
  void add_legend(std::string_view text, std::string_view colour);
  /// The returns of one scan.
  void add_scan(const core::Scan& scan, const core::Pose2& T_map_lidar);
  /// Returns of a whole drive, on the map.
  void add_points(std::span<const core::Vec2> points);
  /// A stretch of wall that nothing was seen of.
  void add_thin(const core::Vec2& from, const core::Vec2& to);
  /// What an import left out, as a cross; where it closed a gap, a ring of its width.
  void add_left_out(const core::Vec2& place);
  void add_closed(const core::Vec2& place, double width_m);
  /// Corners as rings, terminals as squares.
  void add_breakpoints(std::span<const core::Breakpoint> breakpoints,
                       const core::Pose2& T_map_lidar);
  /// The robot as an arrowhead.
  void add_pose(const core::Pose2& T_map_base);
  /// The ellipse that holds the true position 95 times of 100.
  void add_uncertainty(const core::Pose2& T_map_base, const core::Covariance3& covariance);

  /// Places that one scan tells from all others, and those that it does not, with lines to what
  /// they look like.
  void add_examined_places(std::span<const ExaminedPlace> places);

  /// What a pixel of the picture is in the map.
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
