// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <stop_token>
#include <string>
#include <vector>

#include "drivers/driver_clock.hpp"
#include "drivers/rplidar/decoder.hpp"
#include "drivers/rplidar/protocol/answers.hpp"
#include "drivers/rplidar/protocol/framing.hpp"
#include "drivers/rplidar/scan_mode.hpp"
#include "drivers/serial/byte_stream.hpp"

namespace cornerd::rplidar {

/// Detects measurement packets of any format in unsolicited bytes.
class MeasurementSearch : private RawSampleSink {
 public:
  void add(std::span<const std::uint8_t> bytes) { decoder_.feed(bytes, *this); }
  bool found() const { return found_; }

 private:
  void on_sample(const RawSample& /*sample*/) override { found_ = true; }
  void on_gap() override {}

  Decoder decoder_;
  bool found_ = false;
};

/// The request that sets the motor's speed, and its values.
struct MotorRequest {
  Command command = Command::kSetMotorSpeed;
  std::uint16_t value = 0;

  Request start() const { return Request::set_motor(command, value); }
  Request stop() const { return Request::set_motor(command, 0); }
};

/// Requests to an RPLidar that is not scanning, one answer each. Each has a time limit and ends
/// early if a stop is requested. Answers are searched for in the received bytes, since a device
/// that was left scanning, or was just switched on, sends bytes unasked.
class Device {
 public:
  Device(drivers::ByteStream& port, drivers::Clock& clock, std::stop_token stop)
      : port_(port), clock_(clock), stop_(std::move(stop)) {}

  /// Reads unsolicited bytes until the line is idle for 40 ms, 100 ms at most.
  void listen(MeasurementSearch& search);
  /// Sends STOP and drains the line. False if the port is lost.
  bool stop_scan();
  /// Sends RESET and drains the boot banner. False if the port is lost.
  bool reset();
  /// GET_INFO, asked up to `tries` times.
  std::optional<DeviceInfo> info(int tries = 5);
  std::optional<Health> health();
  /// As the device lists them where it has GET_LIDAR_CONF; else by firmware: the two periods from
  /// 1.17 on, standard alone before. Modes with an unknown answer type are left out.
  std::vector<ScanMode> modes(const DeviceInfo& info);
  /// How the motor is set by request, as the vendor's SDK decides: S series by speed, A2 and A3 by
  /// the accessory board's PWM if there is one; nullopt: by the port's line or by the scan itself.
  std::optional<MotorRequest> motor_request(const DeviceInfo& info);
  /// Requests a scan. The decoder reads the answer.
  bool start(const ScanMode& mode) { return send(mode.request()); }

  bool send(const Request& request);

  /// The port is gone.
  bool lost() const { return lost_; }
  /// Bytes received since the device was opened, and those of them that were answers.
  std::uint64_t received_bytes() const { return received_bytes_; }
  std::uint64_t used_bytes() const { return used_bytes_; }
  /// The banner came unasked: the device was just switched on.
  bool booted() const { return booted_; }

 private:
  using Milliseconds = std::chrono::milliseconds;
  using Answer = std::span<const std::uint8_t>;

  std::optional<Answer> query(const Request& request, AnswerType type);
  void wait_for_boot();
  std::optional<ConfAnswer> query_conf(ConfType type, std::optional<std::uint16_t> mode = {});
  std::optional<ScanMode> conf_mode(std::uint16_t id);
  void read_until_idle(Milliseconds idle, Milliseconds limit, bool wait_for_first);
  drivers::ByteStream::ReadResult read(Milliseconds timeout);

  drivers::ByteStream& port_;
  drivers::Clock& clock_;
  std::stop_token stop_;
  bool lost_ = false;
  bool booted_ = false;
  bool saw_banner_ = false;  ///< and has not waited for the boot yet
  BannerSearch banner_;
  MeasurementSearch* search_ = nullptr;  ///< receives all bytes while set
  std::uint64_t received_bytes_ = 0;
  std::uint64_t used_bytes_ = 0;
  std::array<std::uint8_t, 256> buffer_{};
  std::array<std::uint8_t, 256> answer_{};
};

}  // namespace cornerd::rplidar
