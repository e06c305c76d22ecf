// SPDX-License-Identifier: MIT
// Localization at known poses under many conditions.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "bench/localization/pose_score.hpp"
#include "bench/localization/world.hpp"
#include "core/map/wall_map.hpp"
#include "replay/simulator/sensor_model.hpp"

namespace cornerd::bench {

/// A map, and the true buildings (at least one) that differ from it.
struct MappedBuilding {
  std::shared_ptr<const core::WallMap> map;
  std::vector<std::shared_ptr<const core::WallMap>> worlds;
};

struct Trial {
  std::string title;
  std::vector<MappedBuilding> buildings;
  replay::SensorModel sensor;
  double map_sigma_m = 0;      ///< of each wall's offset, for the bound
  double clutter = 0;          ///< share of the rays that obstacles stop
  std::size_t scans_each = 1;  ///< at each start pose; the first has no prior
  CircularMotion motion;
  std::size_t updates_per_scan = 1;  ///< above 1, only the poses of partial scans are scored
  bool odometry = false;
  core::TimeNs scan_ns = 137'000'000;
};

/// Accuracy, bias, disturbances and motion: in the arena's layouts, and in the flat where the robot
/// moves.
std::vector<Trial> default_trials(const std::vector<std::shared_ptr<const core::WallMap>>& arenas,
                                  const std::shared_ptr<const core::WallMap>& flat);

/// Divides `poses` random start poses among the trial's buildings; 800 samples a scan.
PoseScore run_trial(const Trial& trial, std::size_t poses, std::uint64_t seed,
                    const std::function<void(std::size_t done)>& progress = {});

}  // namespace cornerd::bench
