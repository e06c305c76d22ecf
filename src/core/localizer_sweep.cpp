// SPDX-License-Identifier: MIT
// In which order the bearings of a scan were measured.
#include <algorithm>

#include "core/localizer_workspace.hpp"

namespace cornerd::core {
namespace {

/// What one scan says of the order at most, and what all have to say, log odds: scans of one
/// rotation are not independent.
constexpr double kMostOfAScan = 2;
constexpr double kSure = 7;
/// Bearings that count up without a step back from one to the next: all but one, of a revolution.
constexpr double kAscendingShare = 0.9;

/// Lidars that rotate clockwise count down: their own samples need no guess.
bool counts_up(const Scan& measured) {
  const auto samples = measured.samples();
  std::size_t up = 0;
  for (std::size_t i = 1; i < samples.size(); ++i) {
    up += samples[i].bearing_rad > samples[i - 1].bearing_rad ? 1 : 0;
  }
  return static_cast<double>(up) > kAscendingShare * static_cast<double>(samples.size());
}

}  // namespace

bool Localizer::Workspace::knows_order() const { return std::abs(sweep_log_odds) >= kSure; }

const Scan& Localizer::Workspace::as_measured(const Scan& measured) {
  if (sweep_log_odds > -kSure || !counts_up(measured)) return measured;
  reversed.assign_reversed(measured);
  return reversed;
}

double Localizer::Workspace::log_odds_at(const Scan& measured, const Pose2& T_map_lidar,
                                         TimeNs t_ns) {
  const bool known = odometer.deskew(measured, config.T_base_lidar, still);
  tried_points.assign(known ? still : measured, config.min_range_m, config.max_range_m, t_ns,
                      known ? Twist2{} : memory.motion(), place->bias.bias());
  place->place_search.begin(tried_points, result.detection.segments, {},
                            {.noise_scale = noise_scale()});
  const PoseHypothesis there{T_map_lidar, 0};
  place->place_search.consider(std::span(&there, 1));
  const auto found = place->place_search.find();
  return found.empty() ? -kMostOfAScan : found.front().log_odds;
}

void Localizer::Workspace::learn_sweep(const Scan& measured, TimeNs t_ns) {
  const std::optional<Prior> prior = memory.prior(t_ns);
  if (!place || !prior || memory.is_stationary() || knows_order() || !counts_up(measured)) {
    return;
  }
  reversed.assign_reversed(measured);
  const double lead = log_odds_at(measured, prior->T_map_lidar, t_ns) -
                      log_odds_at(reversed, prior->T_map_lidar, t_ns);
  sweep_log_odds += std::clamp(lead, -kMostOfAScan, kMostOfAScan);
}

}  // namespace cornerd::core
