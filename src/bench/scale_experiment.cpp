// SPDX-License-Identifier: MIT
#include "bench/scale_experiment.hpp"

#include <algorithm>
#include <cmath>
#include <ctime>

#include "bench/building.hpp"
#include "bench/instruction_counter.hpp"
#include "bench/localization/pose_score.hpp"
#include "bench/simulated_turn.hpp"
#include "bench/statistics.hpp"
#include "core/catalog/catalog.hpp"
#include "replay/simulator/places.hpp"

namespace cornerd::bench {
namespace {

constexpr std::size_t kScaleSamples = 800;
constexpr std::size_t kEqualRooms = 12;
constexpr double kScaleClearance_m = 0.3;

double thread_time_s() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + static_cast<double>(now.tv_nsec) * 1e-9;
}

void judge_pose(const core::PoseEstimate& pose, const core::Pose2& truth, ScaleResult& result) {
  switch (pose.state) {
    case core::PoseState::kFix:
    case core::PoseState::kTracking:
      if (!is_right(pose.T_map_base, truth)) {
        ++result.wrong;
        return;
      }
      ++result.fixed;
      result.mean_error_m += (pose.T_map_base.translation() - truth.translation()).norm();
      return;
    case core::PoseState::kAmbiguous:
      ++result.ambiguous;
      result.ambiguous_with_truth += std::any_of(
          pose.alternatives.begin(), pose.alternatives.end(),
          [&](const core::Alternative& other) { return is_right(other.T_map_base, truth); });
      return;
    case core::PoseState::kPredicted:
    case core::PoseState::kLost:
      ++result.lost;
  }
}

}  // namespace

std::vector<ScaleCase> scale_cases(const std::vector<std::size_t>& corners, std::uint64_t seed) {
  std::vector<ScaleCase> cases;
  for (const std::size_t count : corners) {
    cases.push_back({"offices, about " + std::to_string(count), office_building(count, seed)});
  }
  cases.push_back({std::to_string(kEqualRooms) + " equal rooms", equal_rooms(kEqualRooms)});
  return cases;
}

ScaleTurns::ScaleTurns(std::shared_ptr<const core::WallMap> map, std::size_t turns,
                       std::uint64_t seed)
    : places_(replay::random_places(*map, turns, kScaleClearance_m, seed)) {
  TurnSimulator simulator({}, kScaleSamples, seed + 1);
  for (const core::Pose2& place : places_) turns_.push_back(simulator.take(*map, place));
}

void ScaleTurns::localize(
    core::Localizer& localizer,
    const std::function<void(std::size_t turn, const core::PoseEstimate&)>& done) const {
  for (std::size_t i = 0; i < turns_.size(); ++i) {
    localizer.relocalize();
    done(i, localizer.step(turns_[i]).pose);
  }
}

ScaleResult run_scale_case(const ScaleCase& building, std::size_t turns, std::uint64_t seed) {
  ScaleResult result;
  result.title = building.title;
  result.rooms = building.plan.rooms.size();
  result.turns = turns;
  const core::LocalizerConfig config;
  const double start_s = thread_time_s();
  const auto map = std::make_shared<const core::WallMap>(building.plan);
  result.map_s = thread_time_s() - start_s;
  {
    const double before_s = thread_time_s();
    const core::Catalog catalog(*map, config.max_range_m);
    result.catalog_s = thread_time_s() - before_s;
    result.pairs = catalog.pairs().size();
    result.memory_bytes = map->memory_bytes() + catalog.memory_bytes();
  }
  result.corners = map->corners().size();

  const ScaleTurns simulated(map, turns, seed);
  core::Localizer localizer(map, config);
  std::vector<double> times_us;
  double before_s = thread_time_s();
  simulated.localize(localizer, [&](std::size_t turn, const core::PoseEstimate& pose) {
    times_us.push_back((thread_time_s() - before_s) * 1e6);
    judge_pose(pose, simulated.places()[turn], result);
    before_s = thread_time_s();
  });
  result.mean_error_m /= static_cast<double>(std::max<std::size_t>(1, result.fixed));
  result.time_us = mean_and_spread(times_us).mean;
  std::sort(times_us.begin(), times_us.end());
  result.time_99_us = quantile(times_us, 0.99);

  InstructionCounter counter;
  const auto count = counter.count(
      [&] { simulated.localize(localizer, [](std::size_t, const core::PoseEstimate&) {}); });
  if (count && turns > 0) {
    result.instructions = static_cast<double>(*count) / static_cast<double>(turns);
  }
  return result;
}

}  // namespace cornerd::bench
