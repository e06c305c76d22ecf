// SPDX-License-Identifier: MIT
#include "replay/emulator/make_emulator.hpp"

#include <utility>

#include "replay/emulator/ld_emulator.hpp"
#include "replay/emulator/ydlidar_emulator.hpp"
#include "replay/simulator/time_of_flight_source.hpp"

namespace cornerd::replay {

SimulatorConfig simulator_of(const drivers::LidarModel& model, SimulatorConfig config) {
  config.motor_hz = model.rate_hz;
  config.sensor.min_range_m = model.min_range_m;
  config.sensor.max_range_m = model.max_range_m;
  config.sensor.noise = model.noise();
  return config;
}

std::unique_ptr<DeviceEmulator> make_emulator(const drivers::LidarModel& model,
                                              std::unique_ptr<Scene> scene,
                                              const SimulatorConfig& config,
                                              const EmulatorConfig& a1) {
  const core::TimeNs period_ns = core::from_seconds(1 / model.samples_hz);
  switch (model.driver) {  // no default: -Wswitch names a kind that has no emulator
    case drivers::DriverKind::kRplidar: {
      EmulatorConfig device = a1;
      if (const Firmware* firmware = find_firmware(model.name)) device.firmware = firmware;
      device.baud = model.baud;
      std::unique_ptr<PacketSource> source;
      if (device.firmware->measures_time_of_flight()) {
        source = std::make_unique<TimeOfFlightSource>(std::move(scene), config, period_ns);
      } else {
        source = std::make_unique<Simulator>(std::move(scene), config);
      }
      return std::make_unique<Emulator>(device, std::move(source));
    }
    case drivers::DriverKind::kLd:
      return std::make_unique<LdEmulator>(PacketSimulator(std::move(scene), config, period_ns),
                                          model.baud);
    case drivers::DriverKind::kYdlidar: {
      const bool takes_requests = model.name == "x4";
      return std::make_unique<YdlidarEmulator>(
          PacketSimulator(std::move(scene), config, period_ns, YdlidarEmulator::kOptics),
          model.baud, takes_requests);
    }
    case drivers::DriverKind::kReplay:
      break;
  }
  return nullptr;
}

}  // namespace cornerd::replay
