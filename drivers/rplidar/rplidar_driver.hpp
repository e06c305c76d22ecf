// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "drivers/driver_clock.hpp"
#include "drivers/lidar_driver.hpp"
#include "drivers/rplidar/device.hpp"
#include "drivers/rplidar/motor.hpp"
#include "drivers/rplidar/scan_mode.hpp"
#include "drivers/serial/serial_port.hpp"
#include "drivers/stream/baud_search.hpp"
#include "drivers/stream/status_board.hpp"

namespace cornerd::rplidar {

struct RplidarDriverConfig {
  std::string device = "/dev/ttyUSB0";
  std::vector<std::uint32_t> baud_rates = {115'200};  ///< tried in this order until one answers
  std::string mode = "auto";                          ///< or the name of a mode of the device
  bool inverted = false;                              ///< mounted upside down
  MotorConfig motor;
};

/// An RPLidar on a serial port. Opens the port, identifies and starts the device, delivers samples
/// in the clock's monotonic time, and retries after every failure. Leaves the device stopped, motor
/// off.
class RplidarDriver : public drivers::LidarDriver {
 public:
  using PortOpener = std::function<drivers::OpenResult(std::uint32_t baud)>;

  /// `open_port`: replaces the config's device, for tests and recorders.
  explicit RplidarDriver(RplidarDriverConfig config, PortOpener open_port = nullptr,
                         drivers::Clock& clock = drivers::system_clock());

  void run(std::stop_token stop, drivers::SampleSink& sink) override;
  drivers::LidarStatus status() override { return board_.read(); }
  bool take_change(drivers::LidarChange& change) override { return board_.take_change(change); }

 private:
  /// Why a session ended, and the driver's state until the next one.
  struct Failure {
    drivers::LidarState state = drivers::LidarState::kBackoff;
    drivers::LidarFault fault = drivers::LidarFault::kUnplugged;
    std::string extra = {};  ///< see drivers::hint()
  };

  Failure session(drivers::ByteStream& port, const std::stop_token& stop,
                  drivers::SampleSink& sink);
  Failure identify(Device& device, drivers::ByteStream& port, ScanMode& mode);
  std::optional<DeviceInfo> query_info(Device& device);
  bool start_motor(Device& device, const DeviceInfo& info, drivers::ByteStream& port);
  Failure measure(drivers::ByteStream& port, const ScanMode& mode, const std::stop_token& stop,
                  drivers::SampleSink& sink);
  /// For a device that stopped measuring, perhaps by a protection stop. nullopt: no answer.
  std::optional<Health> query_health_after_silence(drivers::ByteStream& port, const ScanMode& mode,
                                                   const std::stop_token& stop);
  /// Of the family's other speeds; nullopt if all are tried anyway.
  std::optional<std::uint32_t> answering_baud(const std::stop_token& stop);
  /// The lidar as a hint names it.
  std::string described() const { return "an RPLidar at " + rates_.text(); }
  void wait(std::chrono::milliseconds duration, const std::stop_token& stop);
  void report(drivers::LidarState state, drivers::LidarFault fault, std::string_view extra = {});

  RplidarDriverConfig config_;
  drivers::BaudSearch rates_;
  PortOpener open_port_;
  drivers::Clock& clock_;
  std::unique_ptr<Motor> motor_;
  drivers::StatusBoard board_;
  bool reset_first_ = false;                   ///< the last session ended without data
  bool has_run_ = false;                       ///< the last session delivered samples
  std::uint32_t wire_baud_ = 0;                ///< of the session, for the times of its bytes
  std::optional<MotorRequest> motor_request_;  ///< that stops the session's motor
};

}  // namespace cornerd::rplidar
