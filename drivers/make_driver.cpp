// SPDX-License-Identifier: MIT
#include "drivers/make_driver.hpp"

#include <utility>

#include "drivers/ld/ld_protocol.hpp"
#include "drivers/rplidar/rplidar_driver.hpp"
#include "drivers/rplidar/sample_stream.hpp"
#include "drivers/stream/stream_driver.hpp"
#include "drivers/ydlidar/ydlidar_protocol.hpp"

namespace cornerd::drivers {
namespace {

class NoFrameSink : public FrameSink {
 public:
  void on_sample(const FrameSample& /*sample*/) override {}
  void on_gap() override {}
};

std::vector<std::uint32_t> rates_for(const DeviceConfig& config) {
  return config.baud != 0 ? std::vector{config.baud} : baud_rates_of(config.driver);
}

std::unique_ptr<LidarDriver> make_stream_driver(const DeviceConfig& config,
                                                std::unique_ptr<StreamProtocol> protocol,
                                                PortOpener open_port) {
  return std::make_unique<StreamDriver>(
      StreamDriverConfig{config.device, rates_for(config), config.inverted}, std::move(protocol),
      std::move(open_port));
}

}  // namespace

std::unique_ptr<LidarDriver> make_driver(const DeviceConfig& config, PortOpener open_port) {
  switch (config.driver) {  // no default: -Wswitch names a kind that has no driver
    case DriverKind::kRplidar: {
      rplidar::RplidarDriverConfig device;
      device.device = config.device;
      device.baud_rates = rates_for(config);
      device.mode = config.mode;
      device.inverted = config.inverted;
      device.motor = config.motor;
      return std::make_unique<rplidar::RplidarDriver>(std::move(device), std::move(open_port));
    }
    case DriverKind::kLd:
      return make_stream_driver(config, std::make_unique<ld::LdProtocol>(), std::move(open_port));
    case DriverKind::kYdlidar:
      return make_stream_driver(
          config,
          std::make_unique<ydlidar::YdlidarProtocol>(config.motor.kind == rplidar::MotorKind::kDtr),
          std::move(open_port));
    case DriverKind::kReplay:
      break;
  }
  return nullptr;
}

std::unique_ptr<FrameDecoder> make_decoder(DriverKind driver,
                                           std::optional<rplidar::WireFormat> format) {
  switch (driver) {
    case DriverKind::kRplidar:
      return std::make_unique<rplidar::RplidarFrames>(format);
    case DriverKind::kLd:
      return std::make_unique<ld::LdDecoder>();
    case DriverKind::kYdlidar:
      return std::make_unique<ydlidar::YdlidarDecoder>();
    case DriverKind::kReplay:
      break;
  }
  return nullptr;
}

DriverKind detect_driver(std::span<const std::uint8_t> bytes) {
  for (const DriverKind driver : {DriverKind::kLd, DriverKind::kYdlidar}) {
    const auto decoder = make_decoder(driver);
    NoFrameSink sink;
    decoder->feed(bytes, sink);
    if (2 * decoder->counters().used_bytes > bytes.size()) return driver;
  }
  return DriverKind::kRplidar;
}

}  // namespace cornerd::drivers
