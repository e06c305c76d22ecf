// SPDX-License-Identifier: MIT
// What the localizer is put to: places that are known, seen under all kinds of circumstances.
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

/// A map, and the buildings that it may be the map of. `worlds`: at least one.
struct MappedBuilding {
  std::shared_ptr<const core::WallMap> map;
  std::vector<std::shared_ptr<const core::WallMap>> worlds;
};

struct Trial {
  std::string title;
  std::vector<MappedBuilding> buildings;
  replay::SensorModel sensor;
  double clutter = 0;          ///< share of the rays that obstacles stop
  std::size_t scans_each = 1;  ///< at a place, or on a circle; each begins without a prior
  CircularMotion motion;
  std::size_t updates_per_scan = 1;  ///< above 1, the poses of parts of a turn are judged alone
  bool odometry = false;
  core::TimeNs scan_ns = 137'000'000;
};

/// Those of the bench: precision, bias, adversity and motion, in these layouts of the arena and,
/// where a robot needs room to move, in this flat.
std::vector<Trial> default_trials(const std::vector<std::shared_ptr<const core::WallMap>>& arenas,
                                  const std::shared_ptr<const core::WallMap>& flat);

/// `places` random ones, shared by the trial's buildings, turns of 800 samples.
PoseScore run_trial(const Trial& trial, std::size_t places, std::uint64_t seed,
                    const std::function<void(std::size_t done)>& progress = {});

}  // namespace cornerd::bench
