// SPDX-License-Identifier: MIT
#include "survey/plan_wall.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>

#include "core/geometry/squared.hpp"

namespace cornerd::survey {
namespace {

/// How far a drawn wall may be off: across at its middle, and in its direction.
constexpr double kMaxOffset_m = 0.12;
constexpr double kMaxSlope_rad = core::radians(4);
/// How far its ends may be off along it.
constexpr double kMaxEnd_m = 0.2;
/// Standard deviations: of a drawn wall's offset, direction and half its thickness.
constexpr double kDrawnOffset_m = 0.05;
constexpr double kDrawnSlope_rad = core::radians(1.5);
constexpr double kDrawnHalfThickness_m = 0.005;
/// Of a surveyed face's ends across it (src/survey/README.md, figures).
constexpr double kFaceEnd_m = 0.001;
/// A shorter face does not show which wall it lies along.
constexpr double kLeastFace_m = 0.1;
/// Walls that cross at a smaller angle do not fix each other's ends.
constexpr double kLeastCrossing = 0.3;

/// Where the lines of two walls cross; none where they are too parallel.
std::optional<core::Vec2> crossing(const core::Wall& one, const core::Wall& other) {
  const core::Vec2 direction = (one.to - one.from).normalized();
  const core::Vec2 other_direction = (other.to - other.from).normalized();
  const double sine = core::cross(direction, other_direction);
  if (!(std::abs(sine) > kLeastCrossing)) return std::nullopt;
  const double along_m = core::cross(other.from - one.from, other_direction) / sine;
  return one.from + along_m * direction;
}

double distance_to_wall(const core::Wall& wall, const core::Vec2& point) {
  const core::Vec2 span = wall.to - wall.from;
  const double share = std::clamp(span.dot(point - wall.from) / span.squaredNorm(), 0.0, 1.0);
  return (wall.from + share * span - point).norm();
}

}  // namespace

PlanWall::PlanWall(const core::Wall& drawn)
    : drawn_(drawn),
      middle_((drawn.from + drawn.to) / 2),
      half_length_m_((drawn.to - drawn.from).norm() / 2),
      half_thickness_m_(drawn.thickness_m / 2) {
  along_ = half_length_m_ > 0 ? core::Vec2((drawn.to - drawn.from) / (2 * half_length_m_))
                              : core::Vec2(core::Vec2::UnitX());
}

core::Vec2 PlanWall::to_local(const core::Vec2& point) const {
  const core::Vec2 off = point - middle_;
  return {along_.dot(off), core::cross(along_, off)};
}

core::Vec2 PlanWall::to_map(const core::Vec2& local) const {
  return middle_ + local.x() * along_ + local.y() * core::rotate_left(along_);
}

std::optional<PlanWall::Fit> PlanWall::compare_side(const core::Face& face) const {
  const double cosine = face.direction.dot(along_);
  if (std::abs(cosine) < std::cos(kMaxSlope_rad)) return std::nullopt;
  const core::Vec2 from = to_local(face.from);
  const core::Vec2 to = to_local(face.to);
  const double reach_m = half_length_m_ + half_thickness_m_;
  const double begin_m = std::max(std::min(from.x(), to.x()), -reach_m);
  const double end_m = std::min(std::max(from.x(), to.x()), reach_m);
  if (end_m - begin_m < std::min(kLeastFace_m, half_length_m_)) return std::nullopt;
  const double middle_m = (begin_m + end_m) / 2;
  const double share = (middle_m - from.x()) / (to.x() - from.x());
  const double across_m = from.y() + share * (to.y() - from.y());
  // A face has its free side on the left: along the wall it is the left side, else the right.
  const double side_m = cosine > 0 ? half_thickness_m_ : -half_thickness_m_;
  const double off_m = std::abs(across_m - side_m);
  if (off_m > kMaxOffset_m + kMaxSlope_rad * std::abs(middle_m)) return std::nullopt;
  return cosine > 0 ? Fit{off_m, begin_m - from.x(), end_m - from.x()}
                    : Fit{off_m, from.x() - end_m, from.x() - begin_m};
}

std::optional<PlanWall::Fit> PlanWall::compare_end(const core::Face& face) const {
  const double outward = face.normal.dot(along_) > 0 ? 1 : -1;
  if (outward * face.normal.dot(along_) < std::cos(kMaxSlope_rad)) return std::nullopt;
  const core::Vec2 from = to_local(face.from);
  const core::Vec2 to = to_local(face.to);
  const double reach_m = half_thickness_m_ + kMaxOffset_m;
  if (std::max(std::abs(from.y()), std::abs(to.y())) > reach_m) return std::nullopt;
  const double end_m = outward * (from.x() + to.x()) / 2 - half_thickness_m_;
  const double off_m = std::abs(end_m - half_length_m_);
  if (off_m > kMaxEnd_m) return std::nullopt;
  return Fit{off_m, 0, face.length_m, true};
}

void PlanWall::add(const core::Face& face, const Fit& fit) {
  core::Vec2 from = to_local(face.from);
  core::Vec2 to = to_local(face.to);
  if (fit.is_end) {
    const double outward = face.normal.dot(along_) > 0 ? 1 : -1;
    // Square ends reach half a thickness past both points.
    ends_m_[outward > 0 ? 1 : 0] = outward * (from.x() + to.x()) / 2 - half_thickness_m_;
    return;
  }
  const double sign = to.x() > from.x() ? 1 : -1;
  if (sign < 0) std::swap(from, to);
  const double slope = (to.y() - from.y()) / (to.x() - from.x());
  const double reach_m = half_length_m_ + half_thickness_m_ + kMaxEnd_m;
  Side side;
  side.sign = sign;
  side.from_m = std::max(from.x(), -reach_m);
  side.to_m = std::min(to.x(), reach_m);
  side.from_across_m = from.y() + slope * (side.from_m - from.x());
  side.to_across_m = from.y() + slope * (side.to_m - from.x());
  if (side.to_m - side.from_m <= 0) return;
  sides_.push_back(side);
}

void PlanWall::fit() {
  Eigen::Vector3d mean(0, 0, drawn_.thickness_m / 2);
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  information(0, 0) = 1 / core::squared(kDrawnOffset_m);
  information(1, 1) = 1 / core::squared(kDrawnSlope_rad);
  information(2, 2) = 1 / core::squared(drawn_.thickness_m > 0 ? kDrawnHalfThickness_m : 1e-6);
  Eigen::Vector3d sum = information * mean;
  for (const Side& side : sides_) {
    const std::array<core::Vec2, 2> ends{core::Vec2(side.from_m, side.from_across_m),
                                         core::Vec2(side.to_m, side.to_across_m)};
    for (const core::Vec2& end : ends) {
      const Eigen::Vector3d jacobian(1, end.x(), side.sign);
      information += jacobian * jacobian.transpose() / core::squared(kFaceEnd_m);
      sum += jacobian * end.y() / core::squared(kFaceEnd_m);
    }
  }
  const Eigen::Vector3d fitted = information.ldlt().solve(sum);
  offset_m_ = fitted(0);
  slope_rad_ = fitted(1);
  half_thickness_m_ = std::max(fitted(2), 0.0);

  // Parts that were seen from both sides count once.
  std::vector<Side> sorted = sides_;
  std::sort(sorted.begin(), sorted.end(),
            [](const Side& one, const Side& other) { return one.from_m < other.from_m; });
  seen_m_ = 0;
  double end_m = -half_length_m_;
  for (const Side& side : sorted) {
    const double until_m = std::min(side.to_m, half_length_m_);
    seen_m_ += std::max(0.0, until_m - std::max(end_m, side.from_m));
    end_m = std::max(end_m, until_m);
  }
}

core::Vec2 PlanWall::at(double along_m) const {
  return to_map({along_m, offset_m_ + slope_rad_ * along_m});
}

core::Wall PlanWall::wall() const {
  core::Wall moved = drawn_;
  moved.from = at(-half_length_m_);
  moved.to = at(half_length_m_);
  moved.thickness_m = 2 * half_thickness_m_;
  return moved;
}

core::Vec2 PlanWall::direction() const {
  return (at(half_length_m_) - at(-half_length_m_)).normalized();
}

core::Vec2 PlanWall::free_end(bool at_end) const {
  const double outward = at_end ? 1 : -1;
  std::optional<double> farthest_m = ends_m_[at_end ? 1 : 0];
  for (const Side& side : sides_) {
    const double end_m = outward * (at_end ? side.to_m : side.from_m) - half_thickness_m_;
    if (std::abs(end_m - half_length_m_) < kMaxEnd_m) {
      farthest_m = std::max(farthest_m.value_or(end_m), end_m);
    }
  }
  return at(outward * farthest_m.value_or(half_length_m_));
}

std::vector<PlanWall> match_walls(std::span<const core::Wall> drawn,
                                  const std::vector<core::Face>& faces) {
  struct Candidate {
    std::size_t wall = 0;
    PlanWall::Fit fit;
  };
  std::vector<PlanWall> walls(drawn.begin(), drawn.end());
  std::vector<Candidate> candidates;
  for (const core::Face& face : faces) {
    if (face.length_m < kLeastFace_m) continue;
    candidates.clear();
    for (std::size_t i = 0; i < walls.size(); ++i) {
      if (const auto fit = walls[i].compare_side(face)) candidates.push_back({i, *fit});
      if (const auto fit = walls[i].compare_end(face)) candidates.push_back({i, *fit});
    }
    std::sort(candidates.begin(), candidates.end(), [](const Candidate& one, const Candidate& two) {
      return one.fit.off_m < two.fit.off_m;
    });
    // The nearest wall takes the face; those of the same line take what it leaves.
    for (std::size_t i = 0; i < candidates.size(); ++i) {
      const PlanWall::Fit& fit = candidates[i].fit;
      double taken_m = 0;
      for (std::size_t j = 0; j < i; ++j) {
        const PlanWall::Fit& nearer = candidates[j].fit;
        taken_m += std::max(
            0.0, std::min(fit.end_m, nearer.end_m) - std::max(fit.begin_m, nearer.begin_m));
      }
      if (taken_m < (fit.end_m - fit.begin_m) / 2) walls[candidates[i].wall].add(face, fit);
    }
  }
  for (PlanWall& wall : walls) wall.fit();
  return walls;
}

std::optional<core::Vec2> joint_of(const std::vector<PlanWall>& walls, std::size_t i, bool at_end) {
  const core::Wall& drawn = walls[i].drawn();
  const core::Vec2& end = at_end ? drawn.to : drawn.from;
  std::optional<core::Vec2> joint;
  double nearest_m = kMaxEnd_m;
  for (std::size_t j = 0; j < walls.size(); ++j) {
    if (j == i) continue;
    const core::Wall& other = walls[j].drawn();
    const double gap_m = distance_to_wall(other, end) - (drawn.thickness_m + other.thickness_m) / 2;
    if (gap_m >= nearest_m) continue;
    const auto point = crossing(walls[i].wall(), walls[j].wall());
    if (!point || (*point - end).norm() > kMaxEnd_m + kMaxOffset_m + other.thickness_m) continue;
    nearest_m = gap_m;
    joint = point;
  }
  return joint;
}

bool accounts_for(const core::Wall& known, const core::Vec2& point, const core::Vec2& direction,
                  double thickness_m) {
  constexpr double kSamePlace_m = 0.03;
  const double half_m = known.thickness_m / 2;
  const core::Vec2 span = known.to - known.from;
  const double length_m = span.norm();
  const core::Vec2 along = length_m > 0 ? core::Vec2(span / length_m) : core::Vec2::UnitX();
  const double along_m = along.dot(point - known.from);
  if (along_m < -half_m - kSamePlace_m || along_m > length_m + half_m + kSamePlace_m) return false;
  const bool is_parallel = std::abs(core::cross(along, direction)) < std::sin(2 * kMaxSlope_rad);
  const double across_m = std::abs(core::cross(along, point - known.from));
  return across_m < half_m + kSamePlace_m + (is_parallel ? thickness_m / 2 : 0);
}

void reach_neighbours(std::span<const core::Wall> plan, core::Wall& wall) {
  for (const bool at_end : {false, true}) {
    core::Vec2& end = at_end ? wall.to : wall.from;
    double nearest_m = kMaxEnd_m;
    std::optional<core::Vec2> joint;
    for (const core::Wall& other : plan) {
      const double gap_m = distance_to_wall(other, end) - other.thickness_m / 2;
      if (gap_m >= nearest_m) continue;
      if (const auto point = crossing(wall, other)) {
        nearest_m = gap_m;
        joint = point;
      }
    }
    if (joint && (*joint - end).norm() < kMaxEnd_m + wall.thickness_m) end = *joint;
  }
}

}  // namespace cornerd::survey
