// SPDX-License-Identifier: MIT
#include "calibration/found_walls.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>

#include "calibration/median.hpp"
#include "core/breakpoint/line_fit.hpp"
#include "core/geometry/angle.hpp"

namespace cornerd::calibration {
namespace {

constexpr double kWidestRay = core::radians(60);
constexpr double kHalfBin = core::radians(0.3);
constexpr double kLeastSpan = core::radians(20);
constexpr std::size_t kLeastBins = 15;
constexpr std::size_t kMostWalls = 16;
/// The mean of a direction is off its wall by less: skirting boards and sagging paper included.
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

/// The wall that a direction sees, by its own slope.
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

/// The wall that most bins see; nullopt where none of them sees one.
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
  if (most < kLeastBins) return std::nullopt;
  for (int round = 0; round < 3; ++round) {
    const std::vector<BinSpread> on = bins_on(bins, best);
    if (on.size() < kLeastBins) return std::nullopt;
    best = fit_flat_wall(on);
  }
  return best;
}

/// The bin that a return fell into; null where that sees something else. `bins` are in the order of
/// their bearing.
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

std::vector<KnownWall> find_walls(std::span<const BinSpread> bins,
                                  std::span<const Return> returns) {
  std::vector<BinSpread> left(bins.begin(), bins.end());
  std::vector<KnownWall> walls;
  for (std::size_t tries = 0; tries < kMostWalls; ++tries) {
    const auto wall = largest_wall(left);
    if (!wall) break;
    const std::vector<BinSpread> on = bins_on(left, *wall);
    if (on.size() >= kLeastBins && span_of(on, *wall) >= kLeastSpan) {
      walls.push_back(returns_of(*wall, on, returns));
    }
    const std::size_t before = left.size();
    std::erase_if(left, [&](const BinSpread& bin) { return wall->holds(bin); });
    if (left.size() == before) break;
  }
  return walls;
}

}  // namespace cornerd::calibration
