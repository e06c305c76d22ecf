// SPDX-License-Identifier: MIT
#include "core/recognition/place_evidence.hpp"

#include <algorithm>
#include <cmath>

namespace cornerd::core {
namespace {

/// Longer walls show no more.
constexpr double kLongWall_m = 3;

/// Weights of the regression (nats per unit), fitted to the likeliest wrong and the right places of
/// 58,000 simulated scans (random buildings, arenas; map errors, obstacles, views, noise; right,
/// mirrored and other maps) and of 7,500 recorded ones (src/bench/poses.md, "Evidence for a
/// place"). A wrong place beyond the threshold of a fix weighs as much as 4 to 40 right ones below
/// it (a tenth of that among obstacles), in the right map as 100.
struct Weights {
  double intercept = -1.835;
  double face = 1.571;
  double faces_log_ratio = 0.113;
  double wall_end = 1.476;
  double log_map_sigma = -2.217;
  double log_hits = 12.33;
  double log_unexplained = -1.683;
  double log_unpredicted = -3.636;  ///< rays that do not meet the face that they should
  double log_violations = -2.185;
  double violation_share = 19.34;
  double short_share = 34.79;
  double obstacle_share = -26.78;  ///< of the scan's surface
  double log_rays_through = -3.489;
  double log_missing_walls = 3.415;
  double unseen_face = -1.011;
  double segment_share = -11.52;
  double log_segments = 4.7;
  double log_rays = -5.009;
};
constexpr Weights kWeights;

/// Least values of shares and logarithms' arguments: less is no more evidence.
constexpr double kLeastUnexplained = 0.005;
constexpr double kLeastWall_m = 0.3;
constexpr double kLeastSegments = 3;
/// Few scans of the fit have less rays: these count as so many, and are less evidence by the other
/// terms (tests/soak, "laser covered").
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
  const auto hits = static_cast<double>(place.hits);
  const auto violations = static_cast<double>(place.free_space_violations);
  // Laplace's rule: a few rays that all hit show little of the share that does not.
  const auto log_share = [](double count, double of, double least) {
    return std::log(std::max((count + 1) / (of + 1), least));
  };
  const double segments_share = place.faces / std::max(kLeastSegments, scan.segments);
  const double surface_m = scan.wall_m + place.obstacles_m + kLeastWall_m;
  const Weights& w = kWeights;
  const double log_odds =
      w.intercept + w.face * place.faces + w.faces_log_ratio * place.faces_log_ratio +
      w.wall_end * wall_ends +
      w.log_map_sigma * std::log(place.map_sigma_m / BeamModel::kMapSigmas_m.front()) +
      w.log_hits * log_share(hits, rays, 0) +
      w.log_unexplained * log_share(rays - hits, rays, kLeastUnexplained) +
      w.log_unpredicted *
          log_share(place.predicted - place.predicted_hits, place.predicted, 1 / kMostRays) +
      w.log_violations * log_share(violations, rays, 1 / kMostRays) +
      w.violation_share * violations / rays +
      w.short_share * static_cast<double>(place.shorts) / rays +
      w.obstacle_share * place.obstacles_m / surface_m +
      w.log_rays_through * std::log1p(place.rays_through) +
      w.log_missing_walls * std::log1p(place.missing_walls) + w.unseen_face * place.unseen_faces +
      w.segment_share * segments_share + w.log_segments * std::log(std::max(1.0, scan.segments)) +
      w.log_rays * std::log(std::clamp(rays, kFewestRays, kMostRays));
  return hits >= kLeastHitShare * rays ? log_odds : std::min(log_odds, 0.0);
}

}  // namespace cornerd::core
