// SPDX-License-Identifier: MIT
#include "daemon/lidar_factory.hpp"

#include "drivers/rplidar/rplidar_driver.hpp"
#include "replay/replay_driver.hpp"

namespace cornerd::daemon {
namespace {

rplidar::MotorConfig motor_of(const settings::MotorConfig& config) {
  const auto kind = [&config] {
    switch (config.kind) {
      case settings::MotorKind::kGpio:
        return rplidar::MotorKind::kGpio;
      case settings::MotorKind::kPwm:
        return rplidar::MotorKind::kPwm;
      case settings::MotorKind::kNone:
        return rplidar::MotorKind::kNone;
      case settings::MotorKind::kDtr:
        break;
    }
    return rplidar::MotorKind::kDtr;
  };
  return {.kind = kind(), .path = config.path, .duty = config.duty, .period_s = config.period_s};
}

}  // namespace

std::unique_ptr<drivers::LidarDriver> make_lidar(const settings::LidarConfig& config) {
  if (config.driver == settings::DriverKind::kReplay) {
    replay::ReplayDriverConfig replay;
    replay.file = config.file;
    replay.speed = config.speed;
    replay.loop = config.loop;
    replay.recording.inverted = config.mount.inverted;
    return std::make_unique<replay::ReplayDriver>(std::move(replay));
  }
  rplidar::RplidarDriverConfig device;
  device.device = config.device.string();
  device.baud = config.baud;
  device.mode = config.mode;
  device.inverted = config.mount.inverted;
  device.motor = motor_of(config.motor);
  return std::make_unique<rplidar::RplidarDriver>(std::move(device));
}

}  // namespace cornerd::daemon
