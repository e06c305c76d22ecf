// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>

#include "replay/simulator/sensor_model.hpp"
#include "settings/config.hpp"

namespace CLI {
class App;
}

namespace cornerd::tool {

/// How a simulated lidar errs: options over the defaults of the sensor model.
struct SensorOptions {
  std::filesystem::path noise;  ///< a file with the key /lidar/noise, as calibrate noise writes it
  bool real = false;            ///< what real A1s lose and mix up, under all options below
  std::optional<double> floor_m;
  std::optional<double> share;
  std::optional<double> bearing_deg;
  std::optional<double> missing;
  std::optional<double> missing_run;
  std::optional<double> outliers;
  std::optional<double> beam_deg;
  std::optional<double> backward;
  std::optional<double> range_scale;
  std::optional<double> range_offset_m;
  std::optional<double> eccentricity_deg;
  std::optional<double> eccentricity_phase_deg;

  void add_to(CLI::App& command);

  /// `configured`: the noise that the config names; --noise goes before it, floor and share before
  /// any table and the wall model's own sigmas.
  /// Throws settings::SettingsError.
  replay::SensorModel model(const settings::NoiseConfig& configured) const;
};

}  // namespace cornerd::tool
