// SPDX-License-Identifier: MIT
#include "emulated_lidar.hpp"

#include <utility>

#include "replay/simulator/motion.hpp"
#include "replay/simulator/simulator.hpp"
#include "room_recording.hpp"
#include "settings/map_file.hpp"

namespace cornerd::system_test {

EmulatedLidar::EmulatedLidar(const std::filesystem::path& map, const std::filesystem::path& link,
                             const replay::EmulatorConfig& config) {
  auto coverable = std::make_unique<replay::CoverableScene>(std::make_unique<replay::MapScene>(
      settings::load_map(map), replay::stand_still({kTrueX, kTrueY, kTrueTheta})));
  scene_ = coverable.get();
  auto simulator =
      std::make_unique<replay::Simulator>(std::move(coverable), replay::SimulatorConfig{});
  auto device = std::make_unique<replay::Emulator>(config, std::move(simulator));
  device_ = device.get();
  pty_ = std::make_unique<replay::PtyEmulator>(std::move(device), link);
  pty_->set_on_time([this](core::TimeNs t_ns, core::TimeNs /*unix_ns*/) {
    const std::lock_guard lock(mutex_);
    if (action_) std::exchange(action_, nullptr)(*device_, t_ns);
    done_.notify_all();
  });
  thread_ = std::jthread([this](const std::stop_token& stop) { pty_->run(stop); });
}

void EmulatedLidar::act(std::function<void(replay::Emulator&, core::TimeNs)> action) {
  std::unique_lock lock(mutex_);
  action_ = std::move(action);
  done_.wait(lock, [this] { return !action_; });
}

void EmulatedLidar::stop() {
  thread_ = {};
  pty_.reset();
}

}  // namespace cornerd::system_test
