// SPDX-License-Identifier: MIT
#include "bench/corner_experiment.hpp"

#include "core/breakpoint/detector.hpp"
#include "replay/simulator/random_poses.hpp"
#include "replay/simulator/scan_simulator.hpp"

namespace cornerd::bench {

std::vector<Conditions> default_conditions() {
  const auto sensor = [](double floor_m, double share, double missing) {
    replay::SensorModel model;
    model.noise.floor_m = floor_m;
    model.noise.share = share;
    model.missing = missing;
    return model;
  };
  constexpr double kFewMissing = 0.005;
  constexpr double kThirdMissing = 1.0 / 3;
  return {{"sigma max(1.5 mm, 0.5 %)", sensor(0.0015, 0.005, kFewMissing)},
          {"sigma max(1.5 mm, 0.5 %), a third missing", sensor(0.0015, 0.005, kThirdMissing)},
          {"sigma max(3 mm, 1 %)", sensor(0.003, 0.01, kFewMissing)},
          {"sigma max(3 mm, 1 %), a third missing", sensor(0.003, 0.01, kThirdMissing)}};
}

std::vector<MethodScore> score_methods(std::span<const std::shared_ptr<const core::WallMap>> maps,
                                       std::span<const NamedMethod> methods,
                                       const replay::SensorModel& sensor, std::size_t samples,
                                       std::size_t positions, std::uint64_t seed,
                                       const Progress& progress) {
  const core::LocalizerConfig config;
  std::vector<MethodScore> scores;
  std::vector<core::Detector> detectors;
  for (const NamedMethod& method : methods) {
    scores.push_back({method, {}});
    detectors.emplace_back(method.config, config.noise);
  }

  replay::ScanSimulator simulator(sensor, samples, seed);
  core::PolarScan points;
  core::Detection detection;
  std::size_t done = 0;
  for (std::size_t m = 0; m < maps.size(); ++m) {
    const core::WallMap& map = *maps[m];
    const std::size_t share = positions * (m + 1) / maps.size() - positions * m / maps.size();
    replay::CornerTruth truth(map, config.max_range_m);
    for (const core::Pose2& place : replay::random_poses(map, share, kClearance_m, seed + m)) {
      points.assign(simulator.take(map, place), config.min_range_m, config.max_range_m);
      truth.observe(place, points.points());
      for (std::size_t i = 0; i < detectors.size(); ++i) {
        detectors[i].detect(points, detection);
        scores[i].score.add(detection.breakpoints, truth);
      }
      if (progress) progress(++done);
    }
  }
  return scores;
}

}  // namespace cornerd::bench
