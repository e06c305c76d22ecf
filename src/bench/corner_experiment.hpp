// SPDX-License-Identifier: MIT
// How well each method finds corners, over many places.
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

/// Nearer to a wall than this an A1 sees nothing.
inline constexpr double kClearance_m = 0.15;

struct Conditions {
  std::string title;
  replay::SensorModel sensor;
};

/// Range noise of max(1.5 mm, 0.5 %) and of max(3 mm, 1 %), each with 0.5 % and with a third of the
/// returns missing; 0.2 % outliers, bearings off by 0.05 degrees.
std::vector<Conditions> default_conditions();

struct MethodScore {
  NamedMethod method;
  CornerScore score;
};

/// Told now and then how many of the positions are done.
using Progress = std::function<void(std::size_t done)>;

/// All methods see the same turns: one at each of `positions` random places, which the maps share
/// evenly.
std::vector<MethodScore> score_methods(std::span<const std::shared_ptr<const core::WallMap>> maps,
                                       std::span<const NamedMethod> methods,
                                       const replay::SensorModel& sensor, std::size_t samples,
                                       std::size_t positions, std::uint64_t seed,
                                       const Progress& progress = {});

}  // namespace cornerd::bench
