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

inline constexpr core::TimeNs kDefaultScanDuration_ns = 137'000'000;  ///< an uncontrolled A1 at 5 V

/// Scans of `samples` evenly spaced rays, clockwise from the lidar's back, with the sensor model's
/// errors. Ranges and bearings are not rounded to a wire format.
class ScanSimulator {
 public:
  ScanSimulator(const SensorModel& sensor, std::size_t samples, std::uint64_t seed,
                core::TimeNs scan_ns = kDefaultScanDuration_ns);

  /// A lidar at rest. The result is valid until the next call.
  const core::Scan& take(const core::WallMap& map, const core::Pose2& T_map_lidar);
  /// A moving lidar.
  const core::Scan& take(const core::WallMap& map, core::TimeNs start_ns,
                         const Motion& T_map_lidar);

  /// Beyond any map; the sensor model has its own limit.
  static constexpr double kMaxRange_m = 100;

  /// Range at a time, by bearing in the lidar frame of that time; 0: no wall.
  using RangeFunction = std::function<double(core::TimeNs t_ns, double bearing_rad)>;
  const core::Scan& take(core::TimeNs start_ns, const RangeFunction& range_along);

  core::TimeNs scan_ns() const { return scan_ns_; }

 private:
  core::TimeNs scan_ns_;
  SensorErrors errors_;
  std::size_t samples_;
  core::Scan scan_;
};

}  // namespace cornerd::replay
