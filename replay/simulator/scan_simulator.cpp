// SPDX-License-Identifier: MIT
#include "replay/simulator/scan_simulator.hpp"

namespace cornerd::replay {

ScanSimulator::ScanSimulator(const SensorModel& sensor, std::size_t samples, std::uint64_t seed,
                             core::TimeNs scan_ns)
    : scan_ns_(scan_ns), errors_(sensor, seed), samples_(samples) {}

const core::Scan& ScanSimulator::take(const core::WallMap& map, const core::Pose2& T_map_lidar) {
  return take(map, 0, stand_still(T_map_lidar));
}

const core::Scan& ScanSimulator::take(const core::WallMap& map, core::TimeNs start_ns,
                                      const Motion& T_map_lidar) {
  return take(start_ns, [&](core::TimeNs t_ns, double bearing_rad) {
    const core::Pose2 at = T_map_lidar(t_ns, 0);
    return map.range_along(at.translation(), at.theta_rad + bearing_rad, kMaxRange_m);
  });
}

const core::Scan& ScanSimulator::take(core::TimeNs start_ns, const RangeFunction& range_along) {
  scan_.clear();
  for (std::size_t i = 0; i < samples_; ++i) {
    const double share = (static_cast<double>(i) + 0.5) / static_cast<double>(samples_);
    const double bearing_rad = core::kPi - core::kTwoPi * share;
    core::Sample sample;
    sample.t_ns = start_ns + static_cast<core::TimeNs>(share * static_cast<double>(scan_ns_));
    const double direction_rad = bearing_rad - errors_.direction_error(-bearing_rad);
    const double range_m = range_along(sample.t_ns, direction_rad);
    sample.bearing_rad = static_cast<float>(bearing_rad);
    sample.range_m = static_cast<float>(errors_.sees(bearing_rad) ? errors_.measured(range_m) : 0);
    sample.starts_scan = i == 0;
    scan_.add(sample);
  }
  return scan_;
}

}  // namespace cornerd::replay
