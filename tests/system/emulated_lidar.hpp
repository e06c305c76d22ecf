// SPDX-License-Identifier: MIT
#pragma once

#include <condition_variable>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <thread>

#include "replay/emulator/emulator.hpp"
#include "replay/emulator/pty_emulator.hpp"
#include "replay/simulator/scene.hpp"

namespace cornerd::system_test {

/// An emulated A1 at rest in a room, on a pseudo-terminal that can be unplugged.
class EmulatedLidar {
 public:
  /// `map`: the room; `link`: path of the port.
  EmulatedLidar(const std::filesystem::path& map, const std::filesystem::path& link,
                const replay::EmulatorConfig& config = {});
  /// Unplugs it.
  ~EmulatedLidar() { stop(); }
  EmulatedLidar(const EmulatedLidar&) = delete;
  EmulatedLidar& operator=(const EmulatedLidar&) = delete;

  /// Runs the function on the device in the device's thread; returns when it has run.
  void act(std::function<void(replay::Emulator&, core::TimeNs)> action);
  void cover(bool covered) { scene_->cover(covered); }
  void expect_speed(std::uint32_t baud) { pty_->expect_speed(baud); }

 private:
  void stop();

  replay::CoverableScene* scene_ = nullptr;
  replay::Emulator* device_ = nullptr;
  std::unique_ptr<replay::PtyEmulator> pty_;
  std::mutex mutex_;
  std::condition_variable done_;
  std::function<void(replay::Emulator&, core::TimeNs)> action_;
  std::jthread thread_;
};

}  // namespace cornerd::system_test
