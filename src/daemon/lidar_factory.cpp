// SPDX-License-Identifier: MIT
#include "daemon/lidar_factory.hpp"

#include "drivers/rplidar/rplidar_driver.hpp"
#include "replay/replay_driver.hpp"

namespace cornerd::daemon {
std::unique_ptr<drivers::LidarDriver> make_lidar(const settings::LidarConfig& config) {
  switch (config.driver) {  // no default: -Wswitch names a kind that has no driver
    case settings::DriverKind::kReplay: {
      replay::ReplayDriverConfig replay;
      replay.file = config.file;
      replay.speed = config.speed;
      replay.loop = config.loop;
      replay.recording.inverted = config.mount.inverted;
      return std::make_unique<replay::ReplayDriver>(std::move(replay));
    }
    case settings::DriverKind::kRplidar:
      break;
  }
  rplidar::RplidarDriverConfig device;
  device.device = config.device.string();
  device.baud = config.baud;
  device.mode = config.mode;
  device.inverted = config.mount.inverted;
  device.motor = config.motor;
  return std::make_unique<rplidar::RplidarDriver>(std::move(device));
}

}  // namespace cornerd::daemon
