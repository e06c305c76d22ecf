// SPDX-License-Identifier: MIT
#include "calibration/known_wall.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "calibration/median.hpp"
#include "core/geometry/angle.hpp"

namespace cornerd::calibration {
namespace {

constexpr std::size_t kDirections = 360;
constexpr double kFarthestRay = core::radians(70);
constexpr double kNormalRay = core::radians(15);
/// The lidar's own error and the tape's are below this, what else stands about is beyond.
constexpr double kGateM = 0.02;
constexpr double kGateShare = 0.04;
/// The gate for the wall's own returns: wide enough for what the lidar errs by along the wall.
constexpr double kGateSpreads = 5;
constexpr double kLeastGateM = 0.01;
/// Direction and offset can be told apart: the wall is seen over more than a few degrees.
constexpr double kLeastDeterminant = 1e-6;
constexpr int kRefinements = 8;
/// Of a wall 10 degrees wide, once round.
constexpr std::size_t kLeastWallReturns = 10;

double gate_m(double distance_m) { return kGateM + kGateShare * distance_m; }

/// Each return beyond the distance could lie on two walls, left and right of it. Of the directions
/// of all those walls the true one comes up most.
double most_voted_direction(std::span<const Return> returns, double distance_m) {
  std::array<double, kDirections> votes{};
  const auto vote = [&votes](double bearing_rad) {
    const double scan = core::normalize_angle(bearing_rad) / core::kTwoPi + 0.5;
    votes[static_cast<std::size_t>(scan * kDirections) % kDirections] += 1;
  };
  for (const Return& each : returns) {
    const double cosine = distance_m / each.range_m;
    if (cosine > 1 || cosine < std::cos(kFarthestRay)) continue;
    vote(each.bearing_rad + std::acos(cosine));
    vote(each.bearing_rad - std::acos(cosine));
  }
  std::size_t best = 0;
  double most = -1;
  for (std::size_t i = 0; i < kDirections; ++i) {
    double sum = 0;
    for (std::size_t k = 0; k < 5; ++k) sum += votes[(i + kDirections + k - 2) % kDirections];
    if (sum <= most) continue;
    most = sum;
    best = i;
  }
  return core::normalize_angle((static_cast<double>(best) + 0.5) / kDirections * core::kTwoPi -
                               core::kPi);
}

/// A wall under search, and the constant that its ranges err by. Without it an offset of the lidar
/// would turn a wall that is seen farther to one side than to the other.
struct Candidate {
  double distance_m = 0;
  double normal_rad = 0;
  double offset_m = 0;
  double gate_m = 0;  ///< across the wall

  double ray_rad(const Return& each) const {
    return core::angle_between(normal_rad, each.bearing_rad);
  }
  /// How far a return lies behind the wall.
  double behind_m(const Return& each) const {
    return (each.range_m - offset_m) * std::cos(ray_rad(each)) - distance_m;
  }
  bool holds(const Return& each) const {
    return std::abs(ray_rad(each)) <= kFarthestRay && std::abs(behind_m(each)) <= gate_m;
  }
};

/// Direction and offset by least squares across the wall, whose distance is known; and a gate after
/// the returns' spread, so that the walls around the corner fall out. nullopt where the candidate
/// holds next to none.
std::optional<Candidate> refine(std::span<const Return> returns, const Candidate& last) {
  // behind = cos(ray) * (offset - distance * tan(ray) / cos(ray) * turn)
  double aa = 0;
  double ab = 0;
  double bb = 0;
  double ay = 0;
  double by = 0;
  std::vector<double> off_m;
  for (const Return& each : returns) {
    if (!last.holds(each)) continue;
    const double ray_rad = last.ray_rad(each);
    const double a = std::cos(ray_rad);
    const double b = -last.distance_m * std::tan(ray_rad);
    const double y = last.behind_m(each);
    aa += a * a;
    ab += a * b;
    bb += b * b;
    ay += a * y;
    by += b * y;
    off_m.push_back(std::abs(y));
  }
  const double determinant = aa * bb - ab * ab;
  if (off_m.size() < kLeastWallReturns || determinant < kLeastDeterminant * aa * bb) {
    return std::nullopt;
  }
  Candidate next = last;
  next.offset_m += (ay * bb - by * ab) / determinant;
  next.normal_rad += (by * aa - ay * ab) / determinant;
  next.gate_m = std::clamp(kGateSpreads * kMedianToSigma * median(off_m), kLeastGateM, last.gate_m);
  return next;
}

}  // namespace

std::optional<KnownWall> find_known_wall(std::span<const Return> returns, double distance_m) {
  Candidate candidate{distance_m, most_voted_direction(returns, distance_m), 0, gate_m(distance_m)};
  for (int round = 0; round < kRefinements; ++round) {
    const auto next = refine(returns, candidate);
    if (!next) return std::nullopt;
    candidate = *next;
  }
  KnownWall wall{distance_m, core::normalize_angle(candidate.normal_rad), 0, {}};
  std::vector<double> near_normal;
  for (const Return& each : returns) {
    if (!candidate.holds(each)) continue;
    const double ray_rad = candidate.ray_rad(each);
    const double error_m = each.range_m - distance_m / std::cos(ray_rad);
    if (std::abs(ray_rad) <= kNormalRay) near_normal.push_back(distance_m + error_m);
    wall.returns.push_back({distance_m, ray_rad, error_m});
  }
  if (near_normal.empty()) return std::nullopt;
  wall.measured_m = median(near_normal);
  return wall;
}

}  // namespace cornerd::calibration
