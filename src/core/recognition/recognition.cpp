// SPDX-License-Identifier: MIT
#include "core/recognition/recognition.hpp"

#include <algorithm>
#include <cmath>

namespace cornerd::core {
namespace {

/// Breakpoints that form pairs: those that more would only confirm.
constexpr std::size_t kMaxSelected = 7;
constexpr double kMinBaseline_m = 0.15;
/// Least tolerance of a distance between two breakpoints: what a map may be off.
constexpr double kDistanceFloor_m = 0.01;
constexpr double kPatternGateSigmas = 3.5;
constexpr double kDirectionTolerance_rad = radians(15);
/// Two walls meet at an angle that fixes a place only when they are far from parallel.
constexpr double kMinWallSine = 0.5;
/// What a wall may seem to go on past its end: the heading of a short wall is known to a few
/// degrees.
constexpr double kWallEndTolerance_m = 0.10;
/// What a breakpoint may be off at a place that only a pair or a single corner gave.
constexpr double kVoteRadius_m = Catalog::kVisitRadius_m;
/// Places closer than this lead to the same place when they are refined.
constexpr double kSamePlace_m = 0.08;
constexpr double kSameHeading_rad = radians(8);

bool agree(double a_rad, double b_rad) {
  return std::abs(angle_between(a_rad, b_rad)) < kDirectionTolerance_rad;
}

double sigma_of(const Breakpoint& breakpoint) { return std::sqrt(breakpoint.covariance.trace()); }

/// True where the seen piece of wall, at this place, lies on the face.
bool holds(const Face& face, const WallSegment& seen, const Pose2& T_map_lidar) {
  const auto along_m = [&](const Vec2& point) {
    return face.direction.dot(T_map_lidar * point - face.from);
  };
  const double low_m = along_m(seen.first);
  const double high_m = along_m(seen.last);
  return std::min(low_m, high_m) > -kWallEndTolerance_m &&
         std::max(low_m, high_m) < face.length_m + kWallEndTolerance_m;
}

}  // namespace

bool looks_like(const Breakpoint& breakpoint, const Corner& landmark, double heading_rad) {
  if (breakpoint.kind == BreakpointKind::kCorner && breakpoint.convex != landmark.is_convex()) {
    return false;
  }
  if (breakpoint.kind == BreakpointKind::kTerminal && !landmark.is_convex()) return false;
  return (!breakpoint.wall_on_left ||
          agree(breakpoint.left_wall_rad + heading_rad, landmark.left_face_rad)) &&
         (!breakpoint.wall_on_right ||
          agree(breakpoint.right_wall_rad + heading_rad, landmark.right_face_rad));
}

Recognition::Recognition(const WallMap& map, const Catalog& catalog)
    : map_(map), catalog_(catalog) {
  selected_.reserve(kMaxBreakpointsPerTurn);
  hypotheses_.reserve(kMaxHypotheses);
}

void Recognition::select(std::span<const Breakpoint> breakpoints) {
  selected_.clear();
  for (const Breakpoint& breakpoint : breakpoints) selected_.push_back(&breakpoint);
  // The best known first: those whose place is sharp, corners before terminals.
  std::sort(selected_.begin(), selected_.end(), [](const Breakpoint* a, const Breakpoint* b) {
    if (a->kind != b->kind) return a->kind < b->kind;
    return sigma_of(*a) < sigma_of(*b);
  });
}

void Recognition::add(const Pose2& T_map_lidar) {
  if (hypotheses_.size() < kMaxHypotheses) hypotheses_.push_back({T_map_lidar, 0});
}

void Recognition::add_pair(const Breakpoint& first, const Breakpoint& second) {
  const Vec2 seen = second.position - first.position;
  const double distance_m = seen.norm();
  if (distance_m < kMinBaseline_m) return;
  const double tolerance_m =
      kDistanceFloor_m + kPatternGateSigmas * std::hypot(sigma_of(first), sigma_of(second));
  const double seen_rad = std::atan2(seen.y(), seen.x());
  const Vec2 seen_middle = (first.position + second.position) / 2;
  const auto landmarks = catalog_.landmarks();
  const auto propose = [&](const Corner& a, const Corner& b) {
    const Vec2 drawn = b.position - a.position;
    const double heading_rad = normalize_angle(std::atan2(drawn.y(), drawn.x()) - seen_rad);
    if (!looks_like(first, a, heading_rad) || !looks_like(second, b, heading_rad)) return;
    const Vec2 middle = (a.position + b.position) / 2;
    const Vec2 origin = middle - Pose2{0, 0, heading_rad} * seen_middle;
    add({origin.x(), origin.y(), heading_rad});
  };
  for (const LandmarkPair& pair :
       catalog_.pairs_between(distance_m - tolerance_m, distance_m + tolerance_m)) {
    propose(landmarks[pair.a], landmarks[pair.b]);
    propose(landmarks[pair.b], landmarks[pair.a]);
  }
}

std::span<const Hypothesis> Recognition::from_pairs(std::span<const Breakpoint> breakpoints) {
  hypotheses_.clear();
  select(breakpoints);
  const std::size_t count = std::min(selected_.size(), kMaxSelected);
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t j = i + 1; j < count; ++j) add_pair(*selected_[i], *selected_[j]);
  }
  return ranked();
}

std::span<const Hypothesis> Recognition::from_single_corners(
    std::span<const Breakpoint> breakpoints) {
  hypotheses_.clear();
  select(breakpoints);
  for (const Breakpoint* breakpoint : selected_) {
    for (const Corner& landmark : catalog_.landmarks()) {
      // The wall with more samples gives the heading; the other has to agree with it.
      const bool by_left = breakpoint->left_support >= breakpoint->right_support;
      const double heading_rad =
          by_left ? normalize_angle(landmark.left_face_rad - breakpoint->left_wall_rad)
                  : normalize_angle(landmark.right_face_rad - breakpoint->right_wall_rad);
      if (!looks_like(*breakpoint, landmark, heading_rad)) continue;
      const Vec2 origin = landmark.position - Pose2{0, 0, heading_rad} * breakpoint->position;
      add({origin.x(), origin.y(), heading_rad});
    }
  }
  return ranked();
}

void Recognition::add_walls(const WallSegment& first, const WallSegment& second) {
  const double first_rad = std::atan2(first.normal.y(), first.normal.x());
  const double turn_rad =
      angle_between(first_rad, std::atan2(second.normal.y(), second.normal.x()));
  for (const Face& a : map_.faces()) {
    const double heading_rad = normalize_angle(std::atan2(a.normal.y(), a.normal.x()) - first_rad);
    for (const Face& b : map_.faces()) {
      const double sine = cross(a.normal, b.normal);
      if (std::abs(sine) < kMinWallSine) continue;
      if (!agree(std::atan2(sine, a.normal.dot(b.normal)), turn_rad)) continue;
      // Where the sensor is as far from both faces as it saw the walls.
      const double height_a = a.offset_m - first.offset_m;
      const double height_b = b.offset_m - second.offset_m;
      const Pose2 T_map_lidar{(height_a * b.normal.y() - height_b * a.normal.y()) / sine,
                              (height_b * a.normal.x() - height_a * b.normal.x()) / sine,
                              heading_rad};
      if (holds(a, first, T_map_lidar) && holds(b, second, T_map_lidar)) add(T_map_lidar);
    }
  }
}

std::span<const Hypothesis> Recognition::from_walls(std::span<const WallSegment> segments,
                                                    std::span<const Breakpoint> breakpoints) {
  hypotheses_.clear();
  select(breakpoints);
  const WallSegment* first = nullptr;
  const WallSegment* second = nullptr;
  std::uint32_t best = 0;
  for (const WallSegment& a : segments) {
    for (const WallSegment& b : segments) {
      if (std::abs(cross(a.normal, b.normal)) < kMinWallSine) continue;
      const std::uint32_t support = std::min(a.support, b.support);
      if (support <= best) continue;
      best = support;
      first = &a;
      second = &b;
    }
  }
  if (first != nullptr) add_walls(*first, *second);
  return ranked();
}

int Recognition::recognised(std::span<const Breakpoint> breakpoints,
                            const Pose2& T_map_lidar) const {
  int count = 0;
  for (const Breakpoint& breakpoint : breakpoints) {
    const Vec2 point = T_map_lidar * breakpoint.position;
    bool found = false;
    catalog_.visit_near(point, [&](std::uint32_t index) {
      const Corner& landmark = catalog_.landmarks()[index];
      found = found || ((landmark.position - point).squaredNorm() < kVoteRadius_m * kVoteRadius_m &&
                        looks_like(breakpoint, landmark, T_map_lidar.theta_rad));
    });
    count += found ? 1 : 0;
  }
  return count;
}

std::span<const Hypothesis> Recognition::ranked() {
  for (Hypothesis& hypothesis : hypotheses_) {
    hypothesis.votes = 0;
    for (const Breakpoint* breakpoint : selected_) {
      const int vote = recognised(std::span(breakpoint, 1), hypothesis.T_map_lidar);
      hypothesis.votes += breakpoint->kind == BreakpointKind::kCorner ? 2 * vote : vote;
    }
  }
  // Ties are broken by the place, so that equal input gives equal output on every machine.
  std::sort(hypotheses_.begin(), hypotheses_.end(), [](const Hypothesis& a, const Hypothesis& b) {
    if (a.votes != b.votes) return a.votes > b.votes;
    if (a.T_map_lidar.x_m != b.T_map_lidar.x_m) return a.T_map_lidar.x_m < b.T_map_lidar.x_m;
    return a.T_map_lidar.y_m < b.T_map_lidar.y_m;
  });
  std::size_t kept = 0;
  for (const Hypothesis& hypothesis : hypotheses_) {
    const auto is_same = [&](const Hypothesis& other) {
      return same_place(other.T_map_lidar, hypothesis.T_map_lidar, kSamePlace_m, kSameHeading_rad);
    };
    const auto end = hypotheses_.begin() + static_cast<std::ptrdiff_t>(kept);
    if (std::none_of(hypotheses_.begin(), end, is_same)) hypotheses_[kept++] = hypothesis;
  }
  return std::span(hypotheses_).first(kept);
}

}  // namespace cornerd::core
