// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>

#include "drivers/clock.hpp"
#include "drivers/lidar_driver.hpp"
#include "drivers/rplidar/device.hpp"
#include "drivers/rplidar/motor.hpp"
#include "drivers/rplidar/scan_mode.hpp"
#include "drivers/rplidar/status_board.hpp"
#include "drivers/serial/serial_port.hpp"

namespace cornerd::rplidar {

struct RplidarDriverConfig {
  std::string device = "/dev/ttyUSB0";
  std::uint32_t baud = 115200;
  std::string mode = "auto";  ///< or a mode's name as the device gives it
  bool inverted = false;      ///< mounted upside down
  MotorConfig motor;
};

/// An A1 on a serial port: opens it, asks who it is, starts it, delivers its samples on the clock's
/// monotonic time, and begins again after every failure. Leaves it stopped, motor off.
class RplidarDriver : public drivers::LidarDriver {
 public:
  using PortOpener = std::function<drivers::OpenResult(std::uint32_t baud)>;

  /// `open_port`: instead of the config's device, for tests and recorders.
  explicit RplidarDriver(RplidarDriverConfig config, PortOpener open_port = nullptr,
                         drivers::Clock& clock = drivers::system_clock());

  void run(std::stop_token stop, drivers::SampleSink& sink) override;
  drivers::LidarStatus status() override { return board_.read(); }
  bool take_change(drivers::LidarChange& change) override { return board_.take_change(change); }

 private:
  /// Why a session ended, and what the driver is until the next one.
  struct Failure {
    drivers::LidarState state = drivers::LidarState::kBackoff;
    drivers::LidarFault fault = drivers::LidarFault::kUnplugged;
    std::string extra = {};  ///< see hint()
  };

  Failure session(drivers::ByteStream& port, const std::stop_token& stop,
                  drivers::SampleSink& sink);
  Failure converse(Device& device, drivers::ByteStream& port, ScanMode& mode);
  Failure measure(drivers::ByteStream& port, const ScanMode& mode, const std::stop_token& stop,
                  drivers::SampleSink& sink);
  /// Of a device that stopped measuring: it may have stopped to protect itself. nullopt: no answer.
  std::optional<Health> health_of_silent(drivers::ByteStream& port, const ScanMode& mode,
                                         const std::stop_token& stop);
  /// Whether it answers at the speed that every A1 has, where the settings say another.
  bool answers_at_usual_speed(const std::stop_token& stop);
  void wait(std::chrono::milliseconds duration, const std::stop_token& stop);
  void say(drivers::LidarState state, drivers::LidarFault fault, std::string_view extra = {});

  RplidarDriverConfig config_;
  PortOpener open_port_;
  drivers::Clock& clock_;
  std::unique_ptr<Motor> motor_;
  StatusBoard board_;
  bool reset_first_ = false;  ///< the last session ended in silence
  bool has_run_ = false;      ///< the last session delivered samples
};

}  // namespace cornerd::rplidar
