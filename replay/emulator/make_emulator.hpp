// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "drivers/config/lidar_models.hpp"
#include "replay/emulator/device_emulator.hpp"
#include "replay/emulator/emulator.hpp"
#include "replay/simulator/scene.hpp"
#include "replay/simulator/simulator.hpp"

namespace cornerd::replay {

/// Rate, range limits and noise of a model, on top of `config`.
SimulatorConfig simulator_of(const drivers::LidarModel& model, SimulatorConfig config = {});

/// The emulator of a model. `a1`: what an RPLidar alone has; its firmware is an A1's.
std::unique_ptr<DeviceEmulator> make_emulator(const drivers::LidarModel& model,
                                              std::unique_ptr<Scene> scene,
                                              const SimulatorConfig& config,
                                              const EmulatorConfig& a1 = {});

}  // namespace cornerd::replay
