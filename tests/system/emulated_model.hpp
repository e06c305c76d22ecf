// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string_view>
#include <thread>

#include "core/geometry/pose2.hpp"
#include "replay/emulator/pty_emulator.hpp"
#include "replay/simulator/motion.hpp"
#include "replay/simulator/scene.hpp"

namespace cornerd::system_test {

/// What happens to the bytes on their way.
enum class LineFault : std::uint8_t {
  kNone,
  kGarbage,     ///< all are replaced by random ones
  kHalfFrames,  ///< of every 600 bytes the last 20 are lost
  kSilence,     ///< the head is held
};

/// A lidar of the table of models that moves through a map, on a pseudo-terminal that can be
/// unplugged. A client at another baud rate gets noise.
class EmulatedModel {
 public:
  EmulatedModel(std::string_view model, const std::filesystem::path& map,
                const replay::Motion& motion, const std::filesystem::path& link);
  /// Unplugs it.
  ~EmulatedModel();
  EmulatedModel(const EmulatedModel&) = delete;
  EmulatedModel& operator=(const EmulatedModel&) = delete;

  void set_fault(LineFault fault) { fault_.store(fault); }
  void cover(bool covered) { scene_->cover(covered); }
  void expect_speed(std::uint32_t baud) { pty_->expect_speed(baud); }
  /// nullopt before the emulator has run.
  std::optional<core::Pose2> true_pose(double unix_s) const;

 private:
  replay::Motion motion_;
  replay::CoverableScene* scene_ = nullptr;
  std::atomic<LineFault> fault_{LineFault::kNone};
  std::atomic<core::TimeNs> start_unix_ns_{0};
  std::unique_ptr<replay::PtyEmulator> pty_;
  std::jthread thread_;
};

}  // namespace cornerd::system_test
