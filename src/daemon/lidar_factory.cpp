// SPDX-License-Identifier: MIT
#include "daemon/lidar_factory.hpp"

#include "drivers/make_driver.hpp"
#include "replay/replay_driver.hpp"

namespace cornerd::daemon {

std::unique_ptr<drivers::LidarDriver> make_lidar(const settings::LidarConfig& config) {
  if (config.driver == settings::DriverKind::kReplay) {
    replay::ReplayDriverConfig replay;
    replay.file = config.file;
    replay.speed = config.speed;
    replay.loop = config.loop;
    replay.recording.inverted = config.mount.inverted;
    return std::make_unique<replay::ReplayDriver>(std::move(replay));
  }
  return drivers::make_driver({.driver = config.driver,
                               .device = config.device.string(),
                               .baud = config.baud,
                               .mode = config.mode,
                               .inverted = config.mount.inverted,
                               .motor = config.motor});
}

}  // namespace cornerd::daemon
