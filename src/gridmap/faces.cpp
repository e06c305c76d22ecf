// SPDX-License-Identifier: MIT
#include "gridmap/faces.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "gridmap/run_lines.hpp"

namespace cornerd::gridmap {
namespace {

using core::Vec2;

/// Largest distance of a corner from where its border turns, beside the tolerance of the runs.
constexpr double kCornerReach = 2.5;
/// Two lines at a smaller angle have a step between them instead of a corner.
constexpr double kMinSine = 0.05;
/// Two adjacent runs in opposite directions are the faces of a wall that ends.
constexpr double kWallEndCosine = -0.8;
/// Cells around a wall's end in which its farthest point is searched.
constexpr std::size_t kEndSides = 6;
/// Shortest joint.
constexpr double kMinJoint = 0.05;

std::vector<LinkedRun> link_runs(const Border& border, std::vector<Run> runs, std::size_t first) {
  std::vector<LinkedRun> linked;
  // A closed border of one run has no inside.
  if (border.closed && runs.size() < 2) return linked;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    LinkedRun link;
    link.begin = border.points[runs[i].begin].place();
    link.end = border.points[runs[i].end].place();
    if (i > 0 || border.closed) link.previous = first + (i + runs.size() - 1) % runs.size();
    if (i + 1 < runs.size() || border.closed) link.next = first + (i + 1) % runs.size();
    link.run = std::move(runs[i]);
    linked.push_back(std::move(link));
  }
  return linked;
}

/// The end of a wall between its two faces: the border's farthest point there.
Vec2 farthest_around(const Border& border, const Run& one, const Run& next) {
  Vec2 far = border.points[one.end].place();
  const auto look = [&](std::size_t i) {
    const Vec2 place = border.points[i].place();
    if (one.direction.dot(place - far) > 0) far = place;
  };
  for (std::size_t i = one.end - std::min(kEndSides, one.size()); i <= one.end; ++i) look(i);
  const std::size_t last = next.begin + std::min(kEndSides, next.size());
  for (std::size_t i = next.begin; i <= last; ++i) look(i);
  return far;
}

class FaceBuilder {
 public:
  FaceBuilder(const OccupancyGrid& grid, std::vector<Border> borders, const FaceOptions& options)
      : grid_(grid), borders_(std::move(borders)), options_(options) {}

  FaceSet build() {
    collect_runs();
    if (options_.square) square_up(runs_);
    for (LinkedRun& linked : runs_) linked.run.at -= options_.inset * linked.run.normal();
    FaceSet set;
    set.gaps = continue_runs(grid_, options_, runs_);
    place_ends();
    for (std::size_t i = 0; i < runs_.size(); ++i) {
      if (runs_[i].continues == kNoRun) add_face(i, set.faces);
    }
    for (std::size_t i = 0; i < runs_.size(); ++i) {
      if (runs_[i].next != kNoRun) add_joint(to_[i], from_[runs_[i].next], set.faces);
    }
    return set;
  }

 private:
  void collect_runs() {
    for (std::size_t i = 0; i < borders_.size(); ++i) {
      Border& border = borders_[i];
      std::vector<Run> runs = straight_runs(border, options_.tolerance);
      for (LinkedRun& linked : link_runs(border, std::move(runs), runs_.size())) {
        runs_.push_back(std::move(linked));
        border_of_.push_back(i);
      }
    }
    from_.resize(runs_.size());
    to_.resize(runs_.size());
    is_inner_.resize(runs_.size(), false);
  }

  Vec2 on_line(const Run& run, const Vec2& point) const {
    return point - run.height_of(point) * run.normal();
  }

  std::optional<Vec2> corner(const LinkedRun& one, const LinkedRun& next) const {
    const double sine = core::cross(one.run.direction, next.run.direction);
    if (std::abs(sine) < kMinSine) return std::nullopt;
    const double along = core::cross(next.run.at - one.run.at, next.run.direction) / sine;
    const Vec2 meet = one.run.at + along * one.run.direction;
    const double reach = kCornerReach + options_.tolerance + 1.5 * options_.inset;
    if ((meet - one.end).norm() > reach) return std::nullopt;
    return meet;
  }

  void place_ends() {
    for (std::size_t i = 0; i < runs_.size(); ++i) {
      const LinkedRun& one = runs_[i];
      if (one.previous == kNoRun) from_[i] = on_line(one.run, one.begin);
      if (one.next == kNoRun) {
        to_[i] = on_line(one.run, one.end);
        continue;
      }
      const LinkedRun& next = runs_[one.next];
      if (const auto meet = corner(one, next)) {
        to_[i] = from_[one.next] = *meet;
        is_inner_[one.next] = core::cross(one.run.direction, next.run.direction) > 0;
        continue;
      }
      Vec2 cut = one.end;
      if (one.run.direction.dot(next.run.direction) < kWallEndCosine) {
        cut = farthest_around(borders_[border_of_[i]], one.run, next.run) -
              options_.inset * one.run.direction;
      }
      to_[i] = on_line(one.run, cut);
      from_[one.next] = on_line(next.run, cut);
    }
  }

  /// Adds the face of a run and its continuations.
  void add_face(std::size_t first, std::vector<GridFace>& faces) const {
    std::size_t last = first;
    while (runs_[last].continued_by != kNoRun) last = runs_[last].continued_by;
    GridFace face{from_[first], to_[last], runs_[first].run.direction};
    face.enters_from = is_inner_[first];
    face.enters_to = runs_[last].next != kNoRun && is_inner_[runs_[last].next];
    if (face.length() < kMinJoint) {
      add_joint(face.from, face.to, faces);
    } else {
      faces.push_back(face);
    }
  }

  static void add_joint(const Vec2& from, const Vec2& to, std::vector<GridFace>& faces) {
    const double length = (to - from).norm();
    if (length < kMinJoint) return;
    faces.push_back({from, to, (to - from) / length, true});
  }

  const OccupancyGrid& grid_;
  std::vector<Border> borders_;
  const FaceOptions& options_;
  std::vector<LinkedRun> runs_;
  std::vector<std::size_t> border_of_;
  std::vector<Vec2> from_;  ///< ends of the runs
  std::vector<Vec2> to_;
  std::vector<bool> is_inner_;  ///< the run begins in a room's corner
};

}  // namespace

FaceSet build_faces(const OccupancyGrid& grid, std::vector<Border> borders,
                    const FaceOptions& options) {
  return FaceBuilder(grid, std::move(borders), options).build();
}

}  // namespace cornerd::gridmap
