// SPDX-License-Identifier: MIT
#include "bench/paper_experiment.hpp"

#include <algorithm>

#include "bench/nearest_corners.hpp"
#include "bench/scoring.hpp"
#include "bench/simulated_turn.hpp"
#include "bench/workload.hpp"
#include "core/localizer.hpp"

namespace cornerd::bench {
namespace {

using core::BreakpointKind;

double distance_m(const core::Pose2& a, const core::Pose2& b) {
  return (a.translation() - b.translation()).norm();
}

/// The corners that each of the turns shows, one turn after another.
class TruthOfTurns {
 public:
  explicit TruthOfTurns(const PaperTurns& turns) : turns_(turns) {
    for (const auto& map : turns.maps) truths_.emplace_back(*map, limits_.max_range_m);
  }

  const replay::CornerTruth& at(std::size_t turn) {
    const PaperPlace& place = turns_.places[turn];
    points_.assign(turns_.turns[turn], limits_.min_range_m, limits_.max_range_m);
    truths_[place.map].look(place.T_map_lidar, points_.points());
    return truths_[place.map];
  }

 private:
  const core::LocalizerConfig limits_;
  const PaperTurns& turns_;
  std::vector<replay::CornerTruth> truths_;
  core::PolarScan points_;
};

/// Where cornerd says the lidar is, each turn by itself.
std::optional<core::Pose2> localize(core::Localizer& localizer, const core::Scan& turn) {
  localizer.forget();
  const core::PoseEstimate& pose = localizer.step(turn).pose;
  if (pose.state != core::PoseState::kFix) return std::nullopt;
  return pose.T_map_base;
}

PaperResult run_method(const PaperTurns& turns, const NamedMethod& method,
                       std::size_t timing_repeats) {
  core::LocalizerConfig config;
  config.detector = method.config;
  std::vector<core::Localizer> localizers;
  for (const auto& map : turns.maps) localizers.emplace_back(map, config);
  Workload workload(method, turns.turns);
  TruthOfTurns truth(turns);

  PaperResult result{method, std::vector<PlaceResult>(turns.places.size())};
  for (std::size_t i = 0; i < turns.places.size(); ++i) {
    PlaceResult& at = result.places[i];
    const PaperPlace& place = turns.places[i];
    workload.run(i);
    at.breakpoints = workload.detection().breakpoints;

    CornerScore score;
    score.add(at.breakpoints, truth.at(i));
    at.true_corners = score.detections(BreakpointKind::kCorner, Verdict::kTrue);
    at.missed_corners = score.missed();
    at.false_corners = score.detections(BreakpointKind::kCorner, Verdict::kFalse) +
                       score.detections(BreakpointKind::kCorner, Verdict::kAside);

    const auto error_m = [&](const std::optional<core::Pose2>& found) -> std::optional<double> {
      if (!found) return std::nullopt;
      return distance_m(*found, place.T_map_lidar);
    };
    at.nearest_corners_error_m = error_m(
        place_by_nearest_corners(at.breakpoints, *turns.maps[place.map], place.T_map_lidar));
    at.localizer_error_m = error_m(localize(localizers[place.map], turns.turns[i]));
  }
  if (timing_repeats > 0) {
    const std::vector<double> times_us = time_turns_us(workload, timing_repeats);
    for (std::size_t i = 0; i < times_us.size(); ++i) result.places[i].time_us = times_us[i];
  }
  return result;
}

}  // namespace

PaperTurns simulate_paper_turns(std::span<const std::shared_ptr<const core::WallMap>> maps,
                                const replay::SensorModel& sensor, std::size_t samples,
                                std::uint64_t seed) {
  PaperTurns result{{maps.begin(), maps.end()}, paper_places(maps), {}};
  TurnSimulator simulator(sensor, samples, seed);
  for (const PaperPlace& place : result.places) {
    result.turns.push_back(simulator.take(*maps[place.map], place.T_map_lidar));
  }
  return result;
}

std::vector<PaperResult> run_paper_experiment(const PaperTurns& turns,
                                              std::span<const NamedMethod> methods,
                                              std::size_t timing_repeats) {
  std::vector<PaperResult> results;
  for (const NamedMethod& method : methods) {
    results.push_back(run_method(turns, method, timing_repeats));
  }
  return results;
}

std::vector<std::size_t> supported_corners(const PaperTurns& turns) {
  TruthOfTurns truth(turns);
  std::vector<std::size_t> counts;
  for (std::size_t i = 0; i < turns.turns.size(); ++i) {
    const auto corners = truth.at(i).corners();
    counts.push_back(static_cast<std::size_t>(
        std::count_if(corners.begin(), corners.end(), [](const replay::SeenCorner& corner) {
          return corner.view == replay::CornerView::kSupported;
        })));
  }
  return counts;
}

}  // namespace cornerd::bench
