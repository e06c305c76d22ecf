// SPDX-License-Identifier: MIT
// Precision and recall of each corner detector at random poses.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "bench/methods.hpp"
#include "bench/scoring.hpp"
#include "core/map/wall_map.hpp"
#include "replay/simulator/sensor_model.hpp"

namespace cornerd::bench {

/// An A1 measures no shorter range.
inline constexpr double kClearance_m = 0.15;

struct Conditions {
  std::string title;
  replay::SensorModel sensor;
};

/// Range noise of max(1.5 mm, 0.5 %) and of max(3 mm, 1 %), each with 0.5 % and with a third of the
/// returns missing; 0.2 % outliers, bearing noise of 0.05 degrees.
std::vector<Conditions> default_conditions();

struct MethodScore {
  NamedMethod method;
  CornerScore score;
};

/// Called with the number of finished positions.
using Progress = std::function<void(std::size_t done)>;

/// Scores all methods on the same scans: one at each of `positions` random poses, divided evenly
/// among the maps.
std::vector<MethodScore> score_methods(std::span<const std::shared_ptr<const core::WallMap>> maps,
                                       std::span<const NamedMethod> methods,
                                       const replay::SensorModel& sensor, std::size_t samples,
                                       std::size_t positions, std::uint64_t seed,
                                       const Progress& progress = {});

}  // namespace cornerd::bench
