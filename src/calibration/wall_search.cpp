// SPDX-License-Identifier: MIT
#include "calibration/wall_search.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <optional>

#include "calibration/robust_statistics.hpp"
#include "core/breakpoint/line_fit.hpp"
#include "core/geometry/angle.hpp"

namespace cornerd::calibration {
namespace {

constexpr std::size_t kDirections = 360;
constexpr double kFarthestRay = core::radians(70);
constexpr double kNormalRay = core::radians(15);
/// Gate across the wall for the errors of lidar and tape measure.
constexpr double kGateM = 0.02;
constexpr double kGateShare = 0.04;
/// Gate for the wall's returns, wide enough for the lidar's errors along the wall.
constexpr double kGateSpreads = 5;
constexpr double kMinGateM = 0.01;
/// Direction and offset are separable: the wall spans more than a few degrees.
constexpr double kMinDeterminant = 1e-6;
constexpr int kRefinements = 8;
/// One scan of a wall 10 degrees wide.
constexpr std::size_t kMinWallReturns = 10;

double gate_m(double distance_m) { return kGateM + kGateShare * distance_m; }

/// Hough vote: each return farther than the wall's distance fits two wall directions.
double most_voted_direction(std::span<const Return> returns, double distance_m) {
  std::array<double, kDirections> votes{};
  const auto vote = [&votes](double bearing_rad) {
    const double revolution = core::normalize_angle(bearing_rad) / core::kTwoPi + 0.5;
    votes[static_cast<std::size_t>(revolution * kDirections) % kDirections] += 1;
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

/// A wall hypothesis with a constant range offset. Without the offset, a wall that spans more angle
/// on one side of its normal would be rotated.
struct Candidate {
  double distance_m = 0;
  double normal_rad = 0;
  double offset_m = 0;
  double gate_m = 0;  ///< across the wall

  double ray_rad(const Return& each) const {
    return core::angle_between(normal_rad, each.bearing_rad);
  }
  /// Distance of a return behind the wall.
  double behind_m(const Return& each) const {
    return (each.range_m - offset_m) * std::cos(ray_rad(each)) - distance_m;
  }
  bool holds(const Return& each) const {
    return std::abs(ray_rad(each)) <= kFarthestRay && std::abs(behind_m(each)) <= gate_m;
  }
};

/// Least squares of direction and offset at the known distance, and a gate from the median residual
/// that excludes adjacent walls. Nullopt where too few returns fit.
std::optional<Candidate> refine(std::span<const Return> returns, const Candidate& last) {
  // behind = cos(ray) * (offset - distance * tan(ray) / cos(ray) * rotation)
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
  if (off_m.size() < kMinWallReturns || determinant < kMinDeterminant * aa * bb) {
    return std::nullopt;
  }
  Candidate next = last;
  next.offset_m += (ay * bb - by * ab) / determinant;
  next.normal_rad += (by * aa - ay * ab) / determinant;
  next.gate_m = std::clamp(kGateSpreads * kMedianToSigma * median(off_m), kMinGateM, last.gate_m);
  return next;
}

constexpr double kWidestRay = core::radians(60);
constexpr double kHalfBin = core::radians(0.3);
constexpr double kMinSpan = core::radians(20);
constexpr std::size_t kMinBins = 15;
constexpr std::size_t kMaxWalls = 16;
/// Unevenness of a wall: skirting boards, sagging paper.
constexpr double kUneven = 0.004;
constexpr double kUnevenShare = 0.002;  // of the distance
constexpr double kSigmasOfReturn = 5;
constexpr double kBesideNormal = core::radians(15);

struct FlatWall {
  double normal_rad = 0;
  double distance_m = 0;

  double ray_rad(double bearing_rad) const { return core::angle_between(normal_rad, bearing_rad); }
  double gate_m() const { return kUneven + kUnevenShare * distance_m; }
  bool holds(const BinSpread& bin) const {
    const double ray = ray_rad(bin.bearing_rad);
    return std::abs(ray) < kWidestRay &&
           std::abs(bin.range_m * std::cos(ray) - distance_m) < gate_m();
  }
};

/// The wall through a bin, by the bin's slope.
FlatWall wall_of(const BinSpread& bin) {
  const double ray = std::atan(bin.steepness());
  return {core::normalize_angle(bin.bearing_rad - ray), bin.range_m * std::cos(ray)};
}

std::vector<BinSpread> bins_on(std::span<const BinSpread> bins, const FlatWall& wall) {
  std::vector<BinSpread> on;
  std::copy_if(bins.begin(), bins.end(), std::back_inserter(on),
               [&](const BinSpread& bin) { return wall.holds(bin); });
  return on;
}

FlatWall fit_flat_wall(std::span<const BinSpread> bins) {
  core::LineFit fit(bins.front().range_m * core::unit_vector(bins.front().bearing_rad));
  for (const BinSpread& bin : bins) {
    const core::Vec2 point = bin.range_m * core::unit_vector(bin.bearing_rad);
    fit.add(point.x(), point.y(), 1);
  }
  const core::Line line = fit.line();
  return {std::atan2(-line.normal.y(), -line.normal.x()), -line.offset_m};
}

double span_of(std::span<const BinSpread> bins, const FlatWall& wall) {
  double low = 0;
  double high = 0;
  for (const BinSpread& bin : bins) {
    low = std::min(low, wall.ray_rad(bin.bearing_rad));
    high = std::max(high, wall.ray_rad(bin.bearing_rad));
  }
  return high - low;
}

/// The wall in most bins; nullopt where there is none.
std::optional<FlatWall> largest_wall(std::span<const BinSpread> bins) {
  FlatWall best;
  std::size_t most = 0;
  for (const BinSpread& bin : bins) {
    const FlatWall wall = wall_of(bin);
    const auto count = static_cast<std::size_t>(std::count_if(
        bins.begin(), bins.end(), [&](const BinSpread& each) { return wall.holds(each); }));
    if (count <= most) continue;
    most = count;
    best = wall;
  }
  if (most < kMinBins) return std::nullopt;
  for (int round = 0; round < 3; ++round) {
    const std::vector<BinSpread> on = bins_on(bins, best);
    if (on.size() < kMinBins) return std::nullopt;
    best = fit_flat_wall(on);
  }
  return best;
}

/// The bin of a return; null where that bin is not on the wall. `bins` are sorted by bearing.
const BinSpread* bin_of(std::span<const BinSpread> bins, double bearing_rad) {
  const auto next = std::lower_bound(
      bins.begin(), bins.end(), bearing_rad,
      [](const BinSpread& bin, double bearing) { return bin.bearing_rad < bearing; });
  const BinSpread* nearest = nullptr;
  double nearest_rad = kHalfBin;
  for (auto bin = next == bins.begin() ? next : std::prev(next); bin != bins.end(); ++bin) {
    const double apart_rad = std::abs(bin->bearing_rad - bearing_rad);
    if (apart_rad <= nearest_rad) {
      nearest = &*bin;
      nearest_rad = apart_rad;
    }
    if (bin == next) break;
  }
  return nearest;
}

KnownWall returns_of(const FlatWall& wall, std::span<const BinSpread> on,
                     std::span<const Return> returns) {
  KnownWall found{wall.distance_m, wall.normal_rad, 0, {}};
  std::vector<double> beside_normal;
  for (const Return& each : returns) {
    const double ray = wall.ray_rad(each.bearing_rad);
    const BinSpread* bin = bin_of(on, each.bearing_rad);
    if (bin == nullptr) continue;
    const double off_m =
        each.range_m - bin->range_m - bin->slope_m * (each.bearing_rad - bin->bearing_rad);
    if (std::abs(off_m) > kSigmasOfReturn * bin->sigma_m) continue;
    const double error_m = each.range_m - wall.distance_m / std::cos(ray);
    if (std::abs(ray) < kBesideNormal) beside_normal.push_back(wall.distance_m + error_m);
    found.returns.push_back({wall.distance_m, ray, error_m});
  }
  found.measured_m = beside_normal.empty() ? wall.distance_m : median(beside_normal);
  return found;
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

std::vector<KnownWall> find_walls(std::span<const BinSpread> bins,
                                  std::span<const Return> returns) {
  std::vector<BinSpread> left(bins.begin(), bins.end());
  std::vector<KnownWall> walls;
  for (std::size_t tries = 0; tries < kMaxWalls; ++tries) {
    const auto wall = largest_wall(left);
    if (!wall) break;
    const std::vector<BinSpread> on = bins_on(left, *wall);
    if (on.size() >= kMinBins && span_of(on, *wall) >= kMinSpan) {
      walls.push_back(returns_of(*wall, on, returns));
    }
    const std::size_t before = left.size();
    std::erase_if(left, [&](const BinSpread& bin) { return wall->holds(bin); });
    if (left.size() == before) break;
  }
  return walls;
}

}  // namespace cornerd::calibration
