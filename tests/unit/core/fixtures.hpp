// SPDX-License-Identifier: MIT
// Small buildings and simulated scans in them.
#pragma once

#include <cstdint>
#include <memory>
#include <random>

#include "core/map/wall_map.hpp"
#include "core/polar_scan.hpp"
#include "core/scan.hpp"
#include "core/sensor_noise.hpp"

namespace cornerd::core::testing {

/// A closed room with its lower left inner corner at (0, 0).
FloorPlan rectangular_room(double width_m, double depth_m);

/// An L-shaped room of 4 x 3 m without symmetry: its upper right quarter is solid.
FloorPlan l_shaped_room();

/// Equal rectangular rooms side by side, not visible from each other.
FloorPlan equal_rooms(int count);
inline FloorPlan two_equal_rooms() { return equal_rooms(2); }

/// The walls each displaced across themselves by N(0, sigma_m).
FloorPlan with_walls_off(FloorPlan plan, double sigma_m, std::uint64_t seed);

std::shared_ptr<const WallMap> make_map(FloorPlan plan);

struct ScanOptions {
  int samples = 540;
  double missing_share = 0;
  bool with_noise = true;
  SensorNoise noise;
  double first_bearing_rad = 3.0;  ///< bearings fall from here
  ScanMotion motion;               ///< of the lidar, about the middle of the scan
  double scan_s = 0.137;
  TimeNs start_ns = 0;
};

/// Simulated scans, the same on every run.
class ScanSource {
 public:
  explicit ScanSource(std::uint64_t seed = 1) : random_(seed) {}

  Scan take(const WallMap& map, const Pose2& T_map_lidar, const ScanOptions& options = {});
  Pose2 place_in(double low_x_m, double high_x_m, double low_y_m, double high_y_m);
  /// Of N(0, 1).
  double normal();

 private:
  double uniform(double low, double high);
  std::mt19937_64 random_;
};

PolarScan polar(const Scan& scan);

}  // namespace cornerd::core::testing
