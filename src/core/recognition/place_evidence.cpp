// SPDX-License-Identifier: MIT
#include "core/recognition/place_evidence.hpp"

#include <algorithm>
#include <cmath>

namespace cornerd::core {
namespace {

/// Longer walls show no more.
constexpr double kLongWall_m = 3;

/// Weights of the regression (nats per unit), fitted to the likeliest wrong and the right places of
/// 16,000 simulated scans (random buildings, map errors, obstacles, views; right, mirrored and
/// other maps) and of 1,962 recorded ones (src/bench/README.md, "Evidence for a place"). A wrong
/// place beyond the threshold of a fix weighs as much as 40 right ones below it.
struct Weights {
  double intercept = -2.249;
  double faces_log_ratio = 0.1791;
  double face = 0.9266;
  double wall_end = 3.825;
  double wall_end_of_share = -3.717;  ///< wall ends times the share of segments on faces
  double log_map_sigma = -1.354;
  double log_unexplained = -3.934;
  double through_share = -11.54;
  double missing_wall = -0.5738;
  double log_missing = -0.6011;
  double missing_of_share = -8.816;  ///< log(1 + missing walls) times the share of segments
  double obstacle = 0.3188;
  double obstacle_share = -42.29;
  double segment_share = -4.316;
  double log_wall_m = -1.440;
  double log_segments = 6.046;
  double log_rays = -2.802;
};
constexpr Weights kWeights;

/// Least values of shares and logarithms' arguments: less is no more evidence. That of the rays was
/// chosen after the fit, whose scans have about 75 and more (tests/soak, "laser covered").
constexpr double kLeastUnexplained = 0.005;
constexpr double kLeastWall_m = 0.3;
constexpr double kLeastSegments = 3;
constexpr double kLeastRays = 150;

}  // namespace

ScanStructure scan_structure(std::span<const WallSegment> segments) {
  ScanStructure scan;
  scan.segments = static_cast<double>(segments.size());
  for (const WallSegment& segment : segments) {
    scan.wall_m += std::min(kLongWall_m, (segment.last - segment.first).norm());
  }
  return scan;
}

double log_odds_of_place(const BeamStatistics& place, double wall_ends, const ScanStructure& scan) {
  const double rays = std::max(1.0, static_cast<double>(place.rays));
  const auto share = [&](std::size_t count) { return static_cast<double>(count) / rays; };
  const auto log_of = [](double value, double least) { return std::log(std::max(least, value)); };
  // Laplace's rule: a few rays that all hit show little of the share that does not.
  const double unexplained = (rays - static_cast<double>(place.hits) + 1) / (rays + 1);
  const double segments_share = place.faces / std::max(kLeastSegments, scan.segments);
  const double surface_m = scan.wall_m + place.obstacles_m + kLeastWall_m;
  const Weights& w = kWeights;
  return w.intercept + w.faces_log_ratio * place.faces_log_ratio + w.face * place.faces +
         (w.wall_end + w.wall_end_of_share * segments_share) * wall_ends +
         w.log_map_sigma * std::log(place.map_sigma_m / BeamModel::kMapSigmas_m.front()) +
         w.log_unexplained * log_of(unexplained, kLeastUnexplained) +
         w.through_share * share(place.throughs) + w.missing_wall * place.missing_walls +
         w.log_missing * place.log_missing +
         w.missing_of_share * std::log1p(place.missing_walls) * segments_share +
         w.obstacle * place.obstacles + w.obstacle_share * place.obstacles_m / surface_m +
         w.segment_share * segments_share + w.log_wall_m * log_of(scan.wall_m, kLeastWall_m) +
         w.log_segments * log_of(scan.segments, 1) + w.log_rays * log_of(rays, kLeastRays);
}

}  // namespace cornerd::core
