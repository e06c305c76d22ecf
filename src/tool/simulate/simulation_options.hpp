// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

#include "core/map/wall_map.hpp"
#include "replay/simulator/motion.hpp"
#include "replay/simulator/scene.hpp"
#include "replay/simulator/simulator.hpp"
#include "settings/config.hpp"
#include "tool/simulate/sensor_options.hpp"

namespace CLI {
class App;
}

namespace cornerd::tool {

/// Where a simulated robot is and how its lidar errs: what simulate and emulate have in common.
struct SimulationOptions {
  std::string pose;        ///< x,y,theta: stands there
  std::size_t places = 0;  ///< visits so many random places
  std::string path;        ///< "x,y x,y ...": drives along
  std::string scenario;    ///< a drive that has a name, through flat-7
  bool loop = false;       ///< drives the path again and again
  std::int64_t scans_each = 1;
  double speed_m_s = 0.2;
  double yaw_rate_rad_s = 1.5;
  double acceleration_m_s2 = 0;
  double yaw_acceleration_rad_s2 = 0;
  double motor_hz = 7.3;
  SensorOptions sensor;
  std::uint64_t seed = 1;

  void add_to(CLI::App& command);

  bool stands_still() const { return !pose.empty(); }
  /// Turns of the sensor in a recording of which nobody says how long it is.
  std::int64_t default_scans() const;
  /// Throws UsageError unless exactly one of pose, places, path and scenario is given. Says on
  /// standard error where the robot would stand in a wall or outside the building.
  replay::Motion motion(const core::WallMap& map) const;
  replay::DriveConfig drive() const;
  replay::SimulatorConfig simulator(rplidar::WireFormat wire,
                                    const settings::LidarConfig& lidar) const;
};

}  // namespace cornerd::tool
