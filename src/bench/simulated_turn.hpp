// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/geometry/pose2.hpp"
#include "core/map/wall_map.hpp"
#include "core/scan.hpp"
#include "replay/simulator/sensor_model.hpp"

namespace cornerd::bench {

/// Turns of a lidar that stands still: `samples` rays evenly spread over the circle, clockwise as
/// an A1 turns, with the errors of the simulator's sensor. There is no wire in between: ranges and
/// bearings are not rounded, and start at the lidar's back.
class TurnSimulator {
 public:
  TurnSimulator(const replay::SensorModel& sensor, std::size_t samples, std::uint64_t seed);

  /// The result is valid until the next call. Takes the next numbers of the random sequence.
  const core::Scan& take(const core::WallMap& map, const core::Pose2& T_map_lidar);

 private:
  replay::SensorErrors errors_;
  std::size_t samples_;
  core::Scan turn_;
};

}  // namespace cornerd::bench
