// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "core/map/wall_map.hpp"

namespace cornerd::survey {

/// A wall of a drawn plan and the surveyed faces along it: its line and thickness by least squares,
/// with the drawn ones as prior.
class PlanWall {
 public:
  explicit PlanWall(const core::Wall& drawn);

  /// Coordinates in the drawn wall's frame: along it from its middle, and across to the left.
  core::Vec2 to_local(const core::Vec2& point) const;
  core::Vec2 to_map(const core::Vec2& local) const;

  /// How a face lies to the wall that it may be a side or an end of.
  struct Fit {
    double off_m = 0;    ///< from where the wall is drawn
    double begin_m = 0;  ///< part of the face, from face.from
    double end_m = 0;
    bool is_end = false;
  };
  std::optional<Fit> compare_side(const core::Face& face) const;
  std::optional<Fit> compare_end(const core::Face& face) const;
  /// Adds the part of a face that is along the wall, or moves the end to it.
  void add(const core::Face& face, const Fit& fit);
  /// Fits the line to what was added.
  void fit();

  const core::Wall& drawn() const { return drawn_; }
  /// On the fitted line, between the drawn ends.
  core::Wall wall() const;
  core::Vec2 direction() const;
  double seen_m() const { return seen_m_; }
  double moved_m() const { return offset_m_; }
  /// Where the faces end, if that is near the drawn end; else the drawn end on the fitted line.
  core::Vec2 free_end(bool at_end) const;

 private:
  struct Side {
    double from_m = 0;  ///< along
    double to_m = 0;
    double from_across_m = 0;
    double to_across_m = 0;
    double sign = 1;  ///< +1: left of the wall
  };
  core::Vec2 at(double along_m) const;

  core::Wall drawn_;
  core::Vec2 middle_;
  core::Vec2 along_;
  double half_length_m_;
  std::vector<Side> sides_;
  std::array<std::optional<double>, 2> ends_m_;  ///< along: of faces across the wall's ends
  double seen_m_ = 0;
  double offset_m_ = 0;
  double slope_rad_ = 0;
  double half_thickness_m_;
};

/// The walls of a drawn plan, fitted to surveyed faces in the same frame. Each face moves the wall
/// that it is nearest to.
std::vector<PlanWall> match_walls(std::span<const core::Wall> drawn,
                                  const std::vector<core::Face>& faces);

/// Where the end of walls[i] meets another wall of the plan, after both were moved.
std::optional<core::Vec2> joint_of(const std::vector<PlanWall>& walls, std::size_t i, bool at_end);

/// True where a point of a surveyed wall with this direction and thickness is part of `known`.
bool accounts_for(const core::Wall& known, const core::Vec2& point, const core::Vec2& direction,
                  double thickness_m);

/// Extends the ends of a new wall to the walls that it ends just before.
void reach_neighbours(std::span<const core::Wall> plan, core::Wall& wall);

}  // namespace cornerd::survey
