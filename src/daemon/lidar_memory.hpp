// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "core/sensor_bias.hpp"
#include "settings/config.hpp"
#include "settings/learned_lidar.hpp"

namespace cornerd::daemon {

/// Where the settings, or else the service manager, want to have kept what was learnt of the lidar;
/// empty: nowhere. A recording teaches nothing about a device, nor does who may not learn.
std::filesystem::path learned_file(const settings::LidarConfig& config);

/// What was learnt of the lidar, from one run of the daemon to the next. What cannot be read or
/// written is a line in the log, and costs nothing else. For the server's thread.
class LidarMemory {
 public:
  /// `file`: empty: nothing is kept. `configured`: lidar.bias of the settings.
  LidarMemory(std::filesystem::path file, const core::SensorBias& configured);

  /// What was kept, under the same settings; nullopt where there is none.
  std::optional<core::LearnedBias> recall();

  /// The device has said its number. False where what is known is another one's.
  bool recognise(std::string_view serial);

  /// The settings have another lidar.bias now, under which all is learnt anew.
  void reconfigure(const core::SensorBias& configured);

  /// Writes it down where it says more than what is there already: a dozen times in the first
  /// minutes, hardly ever later.
  void keep(const core::LearnedBias& learned);

 private:
  bool is_news(const core::LearnedBias& learned) const;

  std::filesystem::path file_;
  settings::LearnedLidar kept_;  ///< no turns: nothing is kept
  bool forgets_ = false;         ///< what comes may still be of the lidar or settings before
  bool complained_ = false;
};

}  // namespace cornerd::daemon
