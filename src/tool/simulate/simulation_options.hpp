// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/map/wall_map.hpp"
#include "replay/simulator/motion.hpp"
#include "replay/simulator/scene.hpp"
#include "replay/simulator/sensor_model.hpp"
#include "replay/simulator/simulator.hpp"
#include "settings/config.hpp"

namespace cornerd::tool {

class Command;

/// Errors of a simulated lidar: options over the defaults of the sensor model.
struct SensorOptions {
  std::filesystem::path noise;  ///< a file with the key /lidar/noise, as calibrate noise writes it
  bool real = false;            ///< errors of recorded A1s; the options below override
  std::optional<double> floor_m;
  std::optional<double> share;
  std::optional<double> bearing_deg;
  std::optional<double> missing;
  std::optional<double> missing_run;
  std::optional<double> outliers;
  std::optional<double> beam_deg;
  std::optional<double> fov_deg;
  std::optional<double> backward;
  std::optional<double> range_scale;
  std::optional<double> range_offset_m;
  std::optional<double> eccentricity_deg;
  std::optional<double> eccentricity_phase_deg;

  void add_to(Command& command);

  /// `configured`: the config's noise. --noise overrides it; floor and share override tables and
  /// the wall model's sigmas.
  /// Throws settings::SettingsError.
  replay::SensorModel model(const settings::NoiseConfig& configured) const;
};

/// What a simulated lidar measures.
struct SimulatedPlace {
  std::shared_ptr<const core::WallMap> world;  ///< the map with its error and clutter
  replay::Motion motion;
};

/// Options that simulate and emulate share: the place, the robot's motion and the lidar's errors.
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
  std::optional<double> motor_hz;  ///< scan rate; default: the lidar's
  double map_error_m = 0;          ///< standard deviation of a wall's displacement from the map
  double end_error_m = 0;          ///< the same of a wall's ends, in x and in y
  double clutter = 0;              ///< share of the rays that stop at unmapped obstacles
  SensorOptions sensor;
  std::uint64_t seed = 1;

  void add_to(Command& command);

  /// An uncontrolled A1's at 5 V, if not given.
  double rate_hz() const { return motor_hz.value_or(7.3); }
  bool stands_still() const { return !pose.empty(); }
  /// Scans of a recording without --scans.
  std::int64_t default_scans() const;
  bool changes_map() const { return map_error_m > 0 || end_error_m > 0 || clutter > 0; }
  /// The same for every length of a recording. Throws UsageError unless exactly one of pose,
  /// places, path and scenario is given, std::runtime_error if the clutter or a place has no room.
  /// Warns on standard error about points inside walls or outside the building.
  SimulatedPlace place(std::shared_ptr<const core::WallMap> map,
                       const settings::LidarConfig& lidar) const;
  replay::SimulatorConfig simulator(rplidar::WireFormat wire,
                                    const settings::LidarConfig& lidar) const;

 private:
  replay::Motion motion(const core::WallMap& world) const;
  replay::DriveConfig drive() const;
  std::vector<core::Vec2> points() const;
  /// Scans until the motion ends or repeats.
  std::int64_t scans_of_motion() const;
};

}  // namespace cornerd::tool
