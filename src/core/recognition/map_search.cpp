// SPDX-License-Identifier: MIT
#include "core/recognition/map_search.hpp"

#include <algorithm>
#include <cmath>

namespace cornerd::core {
namespace {

constexpr double kHeadingStep_rad = kTwoPi / static_cast<double>(MapSearch::kHeadings);
/// Poses closer than this are one. The field does not tell a wall's two sides apart: a scan of one
/// fits the other too, a wall's thickness away, and these are two poses.
constexpr double kDistinct_m = 0.12;
constexpr double kDistinct_rad = radians(9);
/// A wall shorter than this, or of fewer samples, has no certain direction.
constexpr double kMinWall_m = 0.15;
constexpr std::uint32_t kMinSupport = 8;
/// Shorter ones are legs and posts, which no map has. With less wall than this all rays are taken.
constexpr double kMinPointWall_m = 0.25;
constexpr std::uint32_t kMinPointSupport = 5;
constexpr double kEnoughWall_m = 1.5;
/// Walls count up to these lengths, so that one long wall does not outvote a room.
constexpr double kLongSegment_m = 3;
constexpr double kLongFaces_m = 20;
/// Poses with less than this share of the best score are not the right one
/// (99 % of 3,000 random scans are among those found).
constexpr double kLeastOfBest = 0.75;
/// Headings that turn less wall length into the map's directions than this share of the best one's
/// are left out: furniture may stand across a room, most walls do not.
constexpr double kMinHeadingShare = 0.35;

/// Adds to the two bins next to a direction.
void add(std::span<double, MapSearch::kHeadings> weights, const Vec2& direction, double weight) {
  const double bin = std::atan2(direction.y(), direction.x()) / kHeadingStep_rad + weights.size();
  const double whole = std::floor(bin);
  const auto index = static_cast<std::size_t>(whole);
  weights[index % weights.size()] += weight * (1 - (bin - whole));
  weights[(index + 1) % weights.size()] += weight * (bin - whole);
}

/// Walls differ from their direction in the map by a bin.
void smooth(std::span<double, MapSearch::kHeadings> weights) {
  const double first = weights[0];
  double previous = weights.back();
  for (std::size_t i = 0; i < weights.size(); ++i) {
    const double next = i + 1 < weights.size() ? weights[i + 1] : first;
    const double own = weights[i];
    weights[i] = (previous + 2 * own + next) / 4;
    previous = own;
  }
}

}  // namespace

MapSearch::MapSearch(const WallMap& map) : field_(map) {
  for (const Face& face : map.faces()) add(map_directions_, face.normal, face.length_m);
  for (double& length_m : map_directions_) length_m = std::min(length_m, kLongFaces_m);
  smooth(map_directions_);
  headings_.reserve(kHeadings);
  points_.reserve(kPoints);
  cells_.resize(kHeadings * kPoints);
  queue_.reserve(kMaxNodes);
  found_.reserve(kMaxFound);
}

void MapSearch::select_headings(std::span<const WallSegment> segments) {
  HeadingWeights scan_directions{};
  for (const WallSegment& segment : segments) {
    const double length_m = (segment.last - segment.first).norm();
    if (segment.support < kMinSupport || length_m < kMinWall_m) continue;
    add(scan_directions, segment.normal, std::min(length_m, kLongSegment_m));
  }
  HeadingWeights weights{};
  for (std::size_t direction = 0; direction < kHeadings; ++direction) {
    if (scan_directions[direction] == 0) continue;
    for (std::size_t heading = 0; heading < kHeadings; ++heading) {
      weights[heading] +=
          scan_directions[direction] * map_directions_[(direction + heading) % kHeadings];
    }
  }
  const double best = *std::max_element(weights.begin(), weights.end());
  headings_.clear();
  for (std::size_t heading = 0; heading < kHeadings; ++heading) {
    const double before = weights[(heading + kHeadings - 1) % kHeadings];
    const double at = weights[heading];
    const double after = weights[(heading + 1) % kHeadings];
    if (best > 0 && (at < kMinHeadingShare * best || at <= before || at < after)) continue;
    const double curvature = before + after - 2 * at;
    const double offset = curvature < 0 ? (before - after) / curvature / 2 : 0;
    headings_.push_back((static_cast<double>(heading) + offset) * kHeadingStep_rad);
  }
}

void MapSearch::select_points(std::span<const PolarPoint> points,
                              std::span<const WallSegment> segments) {
  const auto is_wall = [](const WallSegment& segment) {
    return segment.support >= kMinPointSupport &&
           (segment.last - segment.first).norm() >= kMinPointWall_m;
  };
  double length_m = 0;
  for (const WallSegment& segment : segments) {
    if (is_wall(segment)) length_m += (segment.last - segment.first).norm();
  }
  points_.clear();
  double covered_m = 0;  // since the last point
  const double step_m = length_m / static_cast<double>(kPoints);
  for (const WallSegment& segment : segments) {
    if (!is_wall(segment)) continue;
    const double wall_m = (segment.last - segment.first).norm();
    for (double at_m = step_m - covered_m; at_m <= wall_m && points_.size() < kPoints;
         at_m += step_m) {
      points_.push_back(segment.first + at_m / wall_m * (segment.last - segment.first));
    }
    covered_m = std::fmod(covered_m + wall_m, step_m);
  }
  if (length_m >= kEnoughWall_m) return;
  points_.clear();
  for (std::size_t i = 0; i < std::min(kPoints, points.size()); ++i) {
    points_.push_back(points[i * points.size() / std::min(kPoints, points.size())].position());
  }
}

void MapSearch::rotate(std::size_t heading) {
  const double c = std::cos(headings_[heading]);
  const double s = std::sin(headings_[heading]);
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const Vec2 point =
        Vec2(c * points_[i].x() - s * points_[i].y(), s * points_[i].x() + c * points_[i].y()) /
        field_.cell_m();
    cells_[heading * kPoints + i] = {static_cast<std::int32_t>(std::floor(point.x())),
                                     static_cast<std::int32_t>(std::floor(point.y()))};
  }
}

bool MapSearch::push(std::uint16_t heading, int level, int column, int row) {
  if (column >= field_.columns() || row >= field_.rows()) return false;
  ++nodes_;
  if (queue_.size() == queue_.capacity()) {
    complete_ = false;
    return false;
  }
  const int bound = field_.sum_of_max_scores(
      level, column, row, std::span(cells_).subspan(heading * kPoints, points_.size()));
  queue_.push_back({bound, heading, static_cast<std::uint16_t>(level), column, row});
  return true;
}

bool MapSearch::is_found(const Pose2& T_map_lidar) const {
  return std::any_of(found_.begin(), found_.end(), [&](const PoseHypothesis& found) {
    return same_pose(found.T_map_lidar, T_map_lidar, kDistinct_m, kDistinct_rad);
  });
}

/// A heap's order. Ties are broken by place, so that results are the same on every machine.
bool MapSearch::is_worse(const Node& a, const Node& b) {
  if (a.bound != b.bound) return a.bound < b.bound;
  if (a.level != b.level) return a.level > b.level;
  if (a.heading != b.heading) return a.heading > b.heading;
  if (a.row != b.row) return a.row > b.row;
  return a.column > b.column;
}

void MapSearch::begin(std::span<const PolarPoint> points, std::span<const WallSegment> segments) {
  found_.clear();
  queue_.clear();
  headings_.clear();
  nodes_ = 0;
  complete_ = true;
  select_points(points, segments);
  if (points_.empty()) return;
  select_headings(segments);
  constexpr int kTop = LikelihoodField::kLevels - 1;
  for (std::size_t heading = 0; heading < headings_.size(); ++heading) {
    rotate(heading);
    for (int row = 0; row < field_.rows(); row += 1 << kTop) {
      for (int column = 0; column < field_.columns(); column += 1 << kTop) {
        push(static_cast<std::uint16_t>(heading), kTop, column, row);
      }
    }
  }
  std::make_heap(queue_.begin(), queue_.end(), is_worse);
}

void MapSearch::visit(const Node& node) {
  if (node.level == 0) {
    const Vec2 at = field_.lower_left() + field_.cell_m() * Vec2(node.column + 0.5, node.row + 0.5);
    const Pose2 T_map_lidar{at.x(), at.y(), normalize_angle(headings_[node.heading])};
    if (!is_found(T_map_lidar)) found_.push_back({T_map_lidar, mean_score(node)});
    return;
  }
  const int level = node.level - 1;
  for (const int row : {node.row, node.row + (1 << level)}) {
    for (const int column : {node.column, node.column + (1 << level)}) {
      if (push(node.heading, level, column, row)) {
        std::push_heap(queue_.begin(), queue_.end(), is_worse);
      }
    }
  }
}

bool MapSearch::advance(std::size_t nodes) {
  const std::size_t last = std::min(kMaxNodes, nodes_ + nodes);
  while (!queue_.empty() && nodes_ < last) {
    std::pop_heap(queue_.begin(), queue_.end(), is_worse);
    const Node node = queue_.back();
    queue_.pop_back();
    visit(node);
    const bool has_all =
        found_.size() == kMaxFound ||
        (!found_.empty() && mean_score(node) < kLeastOfBest * found_.front().votes);
    if (has_all) queue_.clear();
  }
  if (nodes_ >= kMaxNodes) {
    complete_ = complete_ && queue_.empty();
    queue_.clear();
  }
  return queue_.empty();
}

std::span<const PoseHypothesis> MapSearch::find(std::span<const PolarPoint> points,
                                                std::span<const WallSegment> segments) {
  begin(points, segments);
  advance(kMaxNodes);
  return found_;
}

}  // namespace cornerd::core
