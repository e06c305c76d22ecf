// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>

#include "core/geometry/pose2.hpp"
#include "core/map/wall_map.hpp"
#include "core/scan.hpp"
#include "replay/simulator/motion.hpp"
#include "replay/simulator/sensor_model.hpp"

namespace cornerd::replay {

inline constexpr core::TimeNs kDefaultScanDuration_ns =
    137'000'000;  ///< an A1 that runs free on 5 V

/// Turns of a lidar: `samples` rays evenly spread over the circle, clockwise as an A1 turns, with
/// the errors of the simulator's sensor. There is no wire in between: ranges and bearings are not
/// rounded, and start at the lidar's back.
class ScanSimulator {
 public:
  ScanSimulator(const SensorModel& sensor, std::size_t samples, std::uint64_t seed,
                core::TimeNs scan_ns = kDefaultScanDuration_ns);

  /// Of a lidar that stands still. The result is valid until the next call. Takes the next numbers
  /// of the random sequence.
  const core::Scan& take(const core::WallMap& map, const core::Pose2& T_map_lidar);
  /// Of one that moves.
  const core::Scan& take(const core::WallMap& map, core::TimeNs start_ns,
                         const Motion& T_map_lidar);

  /// Farther than any map reaches: the sensor model has limits of its own.
  static constexpr double kSight_m = 100;

  /// How far one sees at a time, in a direction in the lidar's frame then; 0: no wall.
  using Triangulation = std::function<double(core::TimeNs t_ns, double bearing_rad)>;
  const core::Scan& take(core::TimeNs start_ns, const Triangulation& range_along);

  core::TimeNs scan_ns() const { return scan_ns_; }

 private:
  core::TimeNs scan_ns_;
  SensorErrors errors_;
  std::size_t samples_;
  core::Scan scan_;
};

}  // namespace cornerd::replay
