// SPDX-License-Identifier: MIT
#include "survey/plan_refinement.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "survey/open_parts.hpp"
#include "survey/plan_alignment.hpp"
#include "survey/plan_wall.hpp"

namespace cornerd::survey {
namespace {

/// A drawn wall of which less was seen is left as drawn.
constexpr double kLeastSeen_m = 0.1;
/// A surveyed wall of which more is in no drawn one is new: the width of the narrowest door post.
constexpr double kLeastNew_m = 0.2;
/// Of a wall that a survey has measured: its own error and that of the plan's frame.
constexpr double kSurveyed_m = 0.003;

/// Behind a line: its own other face, and ends of the solids that it meets.
constexpr double kHidden_m = 0.01;

using Interval = std::pair<double, double>;

/// Moves the ends of the walls that meet another in the plan to where both lines cross now, and
/// free ends to where the faces end.
void place_ends(const std::vector<PlanWall>& walls, std::vector<core::Wall>& moved) {
  for (std::size_t i = 0; i < walls.size(); ++i) {
    for (const bool at_end : {false, true}) {
      core::Vec2& end = at_end ? moved[i].to : moved[i].from;
      if (const auto joint = joint_of(walls, i, at_end)) {
        end = *joint;
      } else {
        end = walls[i].free_end(at_end);
      }
    }
  }
}

/// True of the side of a surveyed line that nobody saw: a wall of which one face was seen is a line
/// with free space on its left (build_walls()).
bool is_behind_line(const core::Face& face, std::span<const core::Wall> walls) {
  const core::Vec2 middle = (face.from + face.to) / 2;
  return std::any_of(walls.begin(), walls.end(), [&](const core::Wall& wall) {
    const core::Vec2 span = wall.to - wall.from;
    const double along = span.dot(middle - wall.from);
    return wall.thickness_m == 0 && span.dot(face.direction) < 0 && along > 0 &&
           along < span.squaredNorm() &&
           std::abs(core::cross(span, middle - wall.from)) < kHidden_m * span.norm();
  });
}

/// Faces that the lidar was in front of.
std::vector<core::Face> seen_faces(const core::WallMap& surveyed,
                                   std::span<const core::Vec2> places) {
  constexpr std::size_t kSomePlaces = 300;
  const std::size_t stride = std::max<std::size_t>(1, places.size() / kSomePlaces);
  std::vector<core::Face> faces;
  for (const core::Face& face : surveyed.faces()) {
    if (is_behind_line(face, surveyed.plan().walls)) continue;
    const core::Vec2 before = (face.from + face.to) / 2 + kHidden_m * face.normal;
    for (std::size_t i = 0; i < places.size(); i += stride) {
      const core::Vec2 ray = before - places[i];
      if (face.normal.dot(ray) > 0) continue;
      if (surveyed.range_along(places[i], core::angle_of(ray), ray.norm()) > 0) continue;
      faces.push_back(face);
      break;
    }
  }
  return faces;
}

/// Parts of `wall` that no wall of `plan` accounts for.
std::vector<core::Wall> unexplained(const core::Wall& wall, std::span<const core::Wall> plan) {
  constexpr double kStep_m = 0.02;
  const double length_m = (wall.to - wall.from).norm();
  const core::Vec2 direction = (wall.to - wall.from) / std::max(length_m, 1e-9);
  std::vector<core::Wall> parts;
  std::optional<double> begin_m;
  const auto end_part = [&](double end_m) {
    if (begin_m && end_m - *begin_m >= kLeastNew_m) {
      parts.push_back(wall);
      parts.back().from = wall.from + *begin_m * direction;
      parts.back().to = wall.from + end_m * direction;
      parts.back().is_open = {*begin_m == 0 && wall.is_open[0],
                              end_m == length_m && wall.is_open[1]};
    }
    begin_m.reset();
  };
  for (double along_m = 0; along_m < length_m; along_m += kStep_m) {
    const core::Vec2 point = wall.from + along_m * direction;
    const bool is_known = std::any_of(plan.begin(), plan.end(), [&](const core::Wall& known) {
      return accounts_for(known, point, direction, wall.thickness_m);
    });
    if (is_known) {
      end_part(along_m);
    } else if (!begin_m) {
      begin_m = along_m;
    }
  }
  end_part(length_m);
  return parts;
}

bool is_mostly_open(const core::Wall& wall, std::span<const Interval> open) {
  double open_m = 0;
  for (const Interval& part : open) open_m += part.second - part.first;
  return open_m > (wall.to - wall.from).norm() / 2;
}

/// The wall without its open parts.
std::vector<core::Wall> without(const core::Wall& wall, std::span<const Interval> open) {
  const double length_m = (wall.to - wall.from).norm();
  const core::Vec2 direction = (wall.to - wall.from) / std::max(length_m, 1e-9);
  std::vector<core::Wall> parts;
  double begin_m = 0;
  const auto keep = [&](double end_m) {
    if (end_m - begin_m < kLeastSeen_m) return;
    parts.push_back(wall);
    parts.back().from = wall.from + begin_m * direction;
    parts.back().to = wall.from + end_m * direction;
    parts.back().is_open = {begin_m == 0 && wall.is_open[0], end_m == length_m && wall.is_open[1]};
  };
  // Square ends reach half a thickness past both points.
  const double half_m = wall.thickness_m / 2;
  for (const Interval& part : open) {
    keep(part.first - half_m);
    begin_m = part.second + half_m;
  }
  keep(length_m);
  if (open.empty() && parts.empty()) parts.push_back(wall);
  return parts;
}

}  // namespace

RefinedPlan refine_plan(const core::FloorPlan& drawn, const core::WallMap& surveyed,
                        std::span<const core::Vec2> places, std::span<const core::Vec2> returns) {
  RefinedPlan refined;
  refined.plan = drawn;
  refined.plan.walls.clear();
  refined.plan.hash.clear();
  refined.plan.sigma_m = kSurveyed_m;
  const std::vector<PlanWall> walls = match_walls(drawn.walls, seen_faces(surveyed, places));
  std::vector<core::Wall> moved;
  for (const PlanWall& wall : walls) moved.push_back(wall.wall());
  place_ends(walls, moved);

  const OpenSpace open_space(surveyed, places, returns);
  for (std::size_t i = 0; i < moved.size(); ++i) {
    const core::Vec2 direction = walls[i].direction();
    std::vector<Interval> open = open_space.parts_of(moved[i]);
    const bool is_seen = walls[i].seen_m() >= kLeastSeen_m;
    if (!is_seen && is_mostly_open(moved[i], open)) {
      open = {{0, (moved[i].to - moved[i].from).norm()}};
    }
    for (const Interval& part : open) {
      refined.contradicted.push_back(
          {i, moved[i].from + part.first * direction, moved[i].from + part.second * direction});
    }
    if (is_seen) refined.moved_m.push_back(walls[i].moved_m());
    for (core::Wall& part : without(moved[i], open)) {
      if (!is_seen) {
        part.sigma_m = drawn.walls[i].sigma_m.value_or(drawn.sigma_m);
        refined.unseen.push_back({i, part.from, part.to});
      } else {
        part.sigma_m.reset();
      }
      refined.plan.walls.push_back(part);
    }
  }
  for (const core::Wall& wall : surveyed.plan().walls) {
    for (core::Wall& part : unexplained(wall, refined.plan.walls)) {
      refined.added.push_back(part);
    }
  }
  for (core::Wall& wall : refined.added) {
    reach_neighbours(refined.plan.walls, wall);
  }
  refined.plan.walls.insert(refined.plan.walls.end(), refined.added.begin(), refined.added.end());
  return refined;
}

RefinedPlan refine_to_plan(const RecordedDrive& drive, const core::LocalizerConfig& sensor,
                           const std::shared_ptr<const core::WallMap>& drawn,
                           SurveyResult& result) {
  const core::Pose2 T_plan_survey = align_to_plan(drive, result.T_map_base, drawn, sensor);
  move_frame(fit_to_walls(T_plan_survey, core::WallMap(result.plan), *drawn), result);
  std::vector<core::Vec2> places;
  for (const core::Pose2& T_map_base : result.T_map_base) {
    places.push_back((T_map_base * sensor.T_base_lidar).translation());
  }
  RefinedPlan refined =
      refine_plan(drawn->plan(), core::WallMap(result.plan), places, result.points);
  result.plan = refined.plan;
  return refined;
}

}  // namespace cornerd::survey
