// SPDX-License-Identifier: MIT
// Where a driver is registered: constructs the driver and the decoder of each kind.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "drivers/config/lidar_models.hpp"
#include "drivers/config/motor_config.hpp"
#include "drivers/lidar_driver.hpp"
#include "drivers/rplidar/decoder.hpp"
#include "drivers/serial/serial_port.hpp"
#include "drivers/stream/frame_decoder.hpp"

namespace cornerd::drivers {

struct DeviceConfig {
  DriverKind driver = DriverKind::kRplidar;
  std::string device;
  std::uint32_t baud = 0;  ///< 0: those of its models in turn
  std::string mode = "auto";
  bool inverted = false;
  rplidar::MotorConfig motor;
};

using PortOpener = std::function<OpenResult(std::uint32_t baud)>;

/// Null for kReplay. `open_port`: replaces the device, for recorders.
std::unique_ptr<LidarDriver> make_driver(const DeviceConfig& config,
                                         PortOpener open_port = nullptr);

/// Whose bytes they are, where no response descriptor says so.
struct RecordedWire {
  /// nullopt: detected in a .bin by its first 4096 bytes; an RPLidar's in .ndjson.
  std::optional<DriverKind> driver;
  std::optional<rplidar::WireFormat> format{};  ///< of an RPLidar; nullopt: detect
};

/// `format`: an RPLidar's, of a stream without a response descriptor. Null for kReplay.
std::unique_ptr<FrameDecoder> make_decoder(
    DriverKind driver, std::optional<rplidar::WireFormat> format = std::nullopt);

/// The driver whose packets `bytes` are for more than their half; else kRplidar.
DriverKind detect_driver(std::span<const std::uint8_t> bytes);

}  // namespace cornerd::drivers
