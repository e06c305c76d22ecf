// SPDX-License-Identifier: MIT
#include "bench/simulated_turn.hpp"

namespace cornerd::bench {
namespace {

constexpr double kTurnSight_m = 100;  // the sensor model has limits of its own

}  // namespace

TurnSimulator::TurnSimulator(const replay::SensorModel& sensor, std::size_t samples,
                             std::uint64_t seed, core::TimeNs turn_ns)
    : turn_ns_(turn_ns), errors_(sensor, seed), samples_(samples) {}

const core::Scan& TurnSimulator::take(const core::WallMap& map, const core::Pose2& T_map_lidar) {
  const core::Vec2 origin = T_map_lidar.translation();
  return take(0, [&](core::TimeNs, double bearing_rad) {
    return map.range_along(origin, T_map_lidar.theta_rad + bearing_rad, kTurnSight_m);
  });
}

const core::Scan& TurnSimulator::take(core::TimeNs start_ns, const Sight& range_along) {
  turn_.clear();
  for (std::size_t i = 0; i < samples_; ++i) {
    const double share = (static_cast<double>(i) + 0.5) / static_cast<double>(samples_);
    const double bearing_rad = core::kPi - core::kTwoPi * share;
    core::Sample sample;
    sample.t_ns = start_ns + static_cast<core::TimeNs>(share * static_cast<double>(turn_ns_));
    const double looks_rad = bearing_rad - errors_.direction_error(-bearing_rad);
    const double range_m = range_along(sample.t_ns, looks_rad);
    sample.bearing_rad = static_cast<float>(bearing_rad);
    sample.range_m = static_cast<float>(errors_.measured(range_m));
    sample.starts_turn = i == 0;
    turn_.add(sample);
  }
  return turn_;
}

}  // namespace cornerd::bench
