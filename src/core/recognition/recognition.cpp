// SPDX-License-Identifier: MIT
#include "core/recognition/recognition.hpp"

#include <algorithm>
#include <cmath>

namespace cornerd::core {
namespace {

/// Breakpoints that form pairs; more would only confirm.
constexpr std::size_t kMaxSelected = 7;
/// Limit of the catalogue entries read per scan. kMinPairs pairs are looked up whatever they cost,
/// since a pair may be false.
constexpr std::size_t kMaxEntries = 8192;
constexpr std::size_t kMinPairs = 4;
/// Hypotheses that all breakpoints vote on: the most proposed ones.
constexpr std::size_t kMaxVotedOn = 512;
/// Hypotheses with a smaller share of the best one's votes are dropped.
constexpr double kMinVoteShare = 0.5;
constexpr double kMinBaseline_m = 0.15;
/// Smallest tolerance of a distance between two breakpoints: map errors.
constexpr double kDistanceFloor_m = 0.01;
constexpr double kPatternGateSigmas = 3.5;
constexpr double kDirectionTolerance_rad = radians(15);
/// Error of a breakpoint's position under a hypothesis of one pair or one corner.
constexpr double kVoteRadius_m = Catalog::kVisitRadius_m;
/// Closer hypotheses converge to the same pose.
constexpr double kSamePose_m = 0.08;
constexpr double kSameHeading_rad = radians(8);

bool agree(double a_rad, double b_rad) {
  return std::abs(angle_between(a_rad, b_rad)) < kDirectionTolerance_rad;
}

double sigma_of(const Breakpoint& breakpoint) { return std::sqrt(breakpoint.covariance.trace()); }

}  // namespace

bool matches(const Breakpoint& breakpoint, const Corner& landmark, double heading_rad) {
  if (breakpoint.kind == BreakpointKind::kCorner && breakpoint.convex != landmark.is_convex()) {
    return false;
  }
  if (breakpoint.kind == BreakpointKind::kTerminal && !landmark.is_convex()) return false;
  return (!breakpoint.wall_on_left ||
          agree(breakpoint.left_wall_rad + heading_rad, landmark.left_face_rad)) &&
         (!breakpoint.wall_on_right ||
          agree(breakpoint.right_wall_rad + heading_rad, landmark.right_face_rad));
}

Recognition::Recognition(const Catalog& catalog) : catalog_(catalog), hypotheses_(kMaxHypotheses) {
  selected_.reserve(kMaxBreakpointsPerScan);
  pairs_.reserve(kMaxSelected * (kMaxSelected - 1) / 2);
}

void Recognition::begin(std::span<const Breakpoint> breakpoints) {
  hypotheses_.clear();
  selected_.clear();
  for (const Breakpoint& breakpoint : breakpoints) selected_.push_back(&breakpoint);
  // Most certain first: corners before terminals, then by position sigma.
  std::sort(selected_.begin(), selected_.end(), [](const Breakpoint* a, const Breakpoint* b) {
    if (a->kind != b->kind) return a->kind < b->kind;
    return sigma_of(*a) < sigma_of(*b);
  });
}

void Recognition::add(const Pose2& T_map_lidar) { hypotheses_.add(T_map_lidar); }

void Recognition::select_pair(const Breakpoint& one, const Breakpoint& other) {
  const double distance_m = (other.position - one.position).norm();
  if (distance_m < kMinBaseline_m) return;
  // The longer wall has the more certain direction.
  const auto support = [](const Breakpoint& b) {
    return std::max(b.left_support, b.right_support);
  };
  SelectedPair pair;
  pair.first = support(one) >= support(other) ? &one : &other;
  pair.second = pair.first == &one ? &other : &one;
  const bool by_left =
      pair.first->wall_on_left &&
      (!pair.first->wall_on_right || pair.first->left_support >= pair.first->right_support);
  const Vec2 displacement = pair.second->position - pair.first->position;
  const double tolerance_m =
      kDistanceFloor_m + kPatternGateSigmas * std::hypot(sigma_of(one), sigma_of(other));
  pair.query.low_m = distance_m - tolerance_m;
  pair.query.high_m = distance_m + tolerance_m;
  pair.query.convex = pair.first->kind == BreakpointKind::kTerminal || pair.first->convex;
  pair.query.side = by_left ? FaceSide::kLeft : FaceSide::kRight;
  pair.query.wall_rad =
      angle_between(std::atan2(displacement.y(), displacement.x()),
                    by_left ? pair.first->left_wall_rad : pair.first->right_wall_rad);
  pair.query.tolerance_rad = kDirectionTolerance_rad;
  pair.cost = catalog_.pairs().cost(pair.query);
  pairs_.push_back(pair);
}

void Recognition::add_pair(const SelectedPair& pair) {
  const Breakpoint& first = *pair.first;
  const Breakpoint& second = *pair.second;
  const Vec2 measured = second.position - first.position;
  const double measured_rad = std::atan2(measured.y(), measured.x());
  const Vec2 measured_middle = (first.position + second.position) / 2;
  const auto landmarks = catalog_.landmarks();
  catalog_.pairs().visit(pair.query, [&](const LandmarkPair& candidate) {
    const Corner& a = landmarks[candidate.from];
    const Corner& b = landmarks[candidate.to];
    const Vec2 mapped = b.position - a.position;
    const double heading_rad = normalize_angle(std::atan2(mapped.y(), mapped.x()) - measured_rad);
    if (!matches(first, a, heading_rad) || !matches(second, b, heading_rad)) return;
    const Vec2 middle = (a.position + b.position) / 2;
    const Vec2 origin = middle - Pose2{0, 0, heading_rad} * measured_middle;
    add({origin.x(), origin.y(), heading_rad});
  });
}

std::span<const PoseHypothesis> Recognition::from_pairs(std::span<const Breakpoint> breakpoints) {
  begin(breakpoints);
  pairs_.clear();
  const std::size_t count = std::min(selected_.size(), kMaxSelected);
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t j = i + 1; j < count; ++j) select_pair(*selected_[i], *selected_[j]);
  }
  std::sort(pairs_.begin(), pairs_.end(), [](const SelectedPair& a, const SelectedPair& b) {
    if (a.cost != b.cost) return a.cost < b.cost;
    return a.query.low_m > b.query.low_m;
  });
  std::size_t entries = 0;
  for (std::size_t i = 0; i < pairs_.size(); ++i) {
    entries += pairs_[i].cost;
    if (entries > kMaxEntries && i >= kMinPairs) break;
    add_pair(pairs_[i]);
  }
  return ranked();
}

bool Recognition::has_landmark(const Breakpoint& breakpoint, const Pose2& T_map_lidar, double c,
                               double s) const {
  const Vec2 point(T_map_lidar.x_m + c * breakpoint.position.x() - s * breakpoint.position.y(),
                   T_map_lidar.y_m + s * breakpoint.position.x() + c * breakpoint.position.y());
  bool found = false;
  catalog_.visit_near(point, [&](std::uint32_t index) {
    const Corner& landmark = catalog_.landmarks()[index];
    found = found || ((landmark.position - point).squaredNorm() < kVoteRadius_m * kVoteRadius_m &&
                      matches(breakpoint, landmark, T_map_lidar.theta_rad));
  });
  return found;
}

int Recognition::recognised(std::span<const Breakpoint> breakpoints,
                            const Pose2& T_map_lidar) const {
  const double c = std::cos(T_map_lidar.theta_rad);
  const double s = std::sin(T_map_lidar.theta_rad);
  int count = 0;
  for (const Breakpoint& breakpoint : breakpoints) {
    count += has_landmark(breakpoint, T_map_lidar, c, s) ? 1 : 0;
  }
  return count;
}

int Recognition::votes(const Pose2& T_map_lidar) const {
  const double c = std::cos(T_map_lidar.theta_rad);
  const double s = std::sin(T_map_lidar.theta_rad);
  int votes = 0;
  for (const Breakpoint* breakpoint : selected_) {
    if (!has_landmark(*breakpoint, T_map_lidar, c, s)) continue;
    votes += breakpoint->kind == BreakpointKind::kCorner ? 2 : 1;
  }
  return votes;
}

std::span<const PoseHypothesis> Recognition::ranked() {
  const std::span<PoseHypothesis> hypotheses = hypotheses_.most_voted(kMaxVotedOn);
  for (PoseHypothesis& hypothesis : hypotheses) hypothesis.votes = votes(hypothesis.T_map_lidar);
  std::sort(hypotheses.begin(), hypotheses.end(), is_better);
  const double least = hypotheses.empty() ? 0 : kMinVoteShare * hypotheses.front().votes;
  std::size_t kept = 0;
  for (const PoseHypothesis& hypothesis : hypotheses) {
    if (hypothesis.votes < least) break;
    const auto is_same = [&](const PoseHypothesis& other) {
      return same_pose(other.T_map_lidar, hypothesis.T_map_lidar, kSamePose_m, kSameHeading_rad);
    };
    const auto end = hypotheses.begin() + static_cast<std::ptrdiff_t>(kept);
    if (std::none_of(hypotheses.begin(), end, is_same)) hypotheses[kept++] = hypothesis;
  }
  return hypotheses.first(kept);
}

}  // namespace cornerd::core
