// SPDX-License-Identifier: MIT
#include "bench/scale_experiment.hpp"

#include <algorithm>
#include <cmath>
#include <ctime>

#include "bench/building.hpp"
#include "bench/instruction_counter.hpp"
#include "bench/statistics.hpp"
#include "core/catalog/catalog.hpp"
#include "replay/simulator/random_poses.hpp"
#include "replay/simulator/scan_simulator.hpp"

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

}  // namespace

std::vector<ScaleCase> scale_cases(const std::vector<std::size_t>& corners, std::uint64_t seed) {
  std::vector<ScaleCase> cases;
  for (const std::size_t count : corners) {
    cases.push_back({"offices, about " + std::to_string(count), office_building(count, seed)});
  }
  cases.push_back({std::to_string(kEqualRooms) + " equal rooms", equal_rooms(kEqualRooms)});
  return cases;
}

ScaleScans::ScaleScans(std::shared_ptr<const core::WallMap> map, std::size_t scans,
                       std::uint64_t seed)
    : places_(replay::random_poses(*map, scans, kScaleClearance_m, seed)) {
  replay::ScanSimulator simulator({}, kScaleSamples, seed + 1);
  for (const core::Pose2& place : places_) scans_.push_back(simulator.take(*map, place));
}

void ScaleScans::localize(
    core::Localizer& localizer,
    const std::function<void(std::size_t scan, const core::PoseEstimate&)>& done) const {
  for (std::size_t i = 0; i < scans_.size(); ++i) {
    localizer.relocalize();
    done(i, localizer.step(scans_[i]).pose);
  }
}

ScaleResult run_scale_case(const ScaleCase& building, std::size_t scans, std::uint64_t seed) {
  ScaleResult result;
  result.title = building.title;
  result.rooms = building.plan.rooms.size();
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

  const ScaleScans simulated(map, scans, seed);
  core::Localizer localizer(map, config);
  std::vector<double> times_us;
  double before_s = thread_time_s();
  simulated.localize(localizer, [&](std::size_t scan, const core::PoseEstimate& pose) {
    times_us.push_back((thread_time_s() - before_s) * 1e6);
    result.score.add(pose, simulated.poses()[scan]);
    before_s = thread_time_s();
  });
  result.time_us = mean_and_deviation(times_us).mean;
  std::sort(times_us.begin(), times_us.end());
  result.time_99_us = quantile(times_us, 0.99);

  InstructionCounter counter;
  const auto count = counter.count(
      [&] { simulated.localize(localizer, [](std::size_t, const core::PoseEstimate&) {}); });
  if (count && scans > 0) {
    result.instructions = static_cast<double>(*count) / static_cast<double>(scans);
  }
  return result;
}

}  // namespace cornerd::bench
