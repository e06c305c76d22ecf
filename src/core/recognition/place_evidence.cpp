// SPDX-License-Identifier: MIT
#include "core/recognition/place_evidence.hpp"

#include <algorithm>
#include <cmath>

namespace cornerd::core {
namespace {

/// Longer walls show no more.
constexpr double kLongWall_m = 3;

/// Weights of the regression (nats per unit), fitted to the likeliest wrong and the right places of
/// 55,000 simulated scans (random buildings, map errors, obstacles, views; right, mirrored and
/// other maps) and of 1,962 recorded ones (src/bench/poses.md, "Evidence for a place"). A wrong
/// place beyond the threshold of a fix weighs as much as 40 right ones below it, in the right map
/// as 100.
struct Weights {
  double intercept = -0.6097;
  double face = 1.468;
  double wall_end = 1.694;
  double log_map_sigma = -2.55;
  double log_unexplained = -3.213;
  double log_missing = -1.114;
  double missing_of_share = -9.073;  ///< log(1 + missing walls) times the share of segments
  double obstacle_share = -37.65;
  double segment_share = -9.871;
  double unseen_share = -13.51;
  double root_view = -2.931;
  double log_faces_ratio = 5.096;
  double log_wall_m = -1.543;
  double log_segments = 5.834;
  double log_rays = -3.248;
};
constexpr Weights kWeights;

/// Least values of shares and logarithms' arguments: less is no more evidence.
constexpr double kLeastUnexplained = 0.005;
constexpr double kLeastWall_m = 0.3;
constexpr double kLeastSegments = 3;
constexpr double kLeastRatio = 2;
/// Few scans of the fit have less rays. Such are less evidence the fewer they are (chosen after the
/// fit; tests/soak, "laser covered").
constexpr double kFewestRays = 150;
/// None has more (src/bench/localization/evidence_samples.cpp): such count as so many, an S3's
/// 3,200 (tests/system/lidar_models_test.cpp).
constexpr double kMostRays = 2000;

/// Of the 30,000 right places of the fit that were named none was hit by a smaller share of the
/// rays: a part of a map that the robot has left, or a room that is not drawn yet, is no evidence.
constexpr double kLeastHitShare = 0.45;

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
  const auto log_of = [](double value, double least) { return std::log(std::max(least, value)); };
  // Laplace's rule: a few rays that all hit show little of the share that does not.
  const double unexplained = (rays - static_cast<double>(place.hits) + 1) / (rays + 1);
  const double segments_share = place.faces / std::max(kLeastSegments, scan.segments);
  const double surface_m = scan.wall_m + place.obstacles_m + kLeastWall_m;
  const double unseen_share = place.unseen_faces / (place.unseen_faces + place.faces + 1);
  const Weights& w = kWeights;
  const double log_odds =
      w.intercept + w.face * place.faces + w.wall_end * wall_ends +
      w.log_map_sigma * std::log(place.map_sigma_m / BeamModel::kMapSigmas_m.front()) +
      w.log_unexplained * log_of(unexplained, kLeastUnexplained) +
      w.log_missing * place.log_missing +
      w.missing_of_share * std::log1p(place.missing_walls) * segments_share +
      w.obstacle_share * place.obstacles_m / surface_m + w.segment_share * segments_share +
      w.unseen_share * unseen_share + w.root_view * std::sqrt(place.weakest_view_rad) +
      w.log_faces_ratio * log_of(place.faces_log_ratio, kLeastRatio) +
      w.log_wall_m * log_of(scan.wall_m, kLeastWall_m) + w.log_segments * log_of(scan.segments, 1) +
      w.log_rays *
          (std::log(kFewestRays) + std::abs(std::log(std::min(kMostRays, rays) / kFewestRays)));
  const bool is_fitted = static_cast<double>(place.hits) >= kLeastHitShare * rays;
  return is_fitted ? log_odds : std::min(log_odds, 0.0);
}

}  // namespace cornerd::core
