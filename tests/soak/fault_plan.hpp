// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>

#include "replay/emulator/emulated_device.hpp"
#include "replay/simulator/scene.hpp"

namespace cornerd::soak {

/// How often, and what.
struct FaultConfig {
  double mean_pause_s = 8;  ///< between two: long enough for poses to come back
  double max_duration_s = 6;
  std::optional<std::size_t> only;  ///< of FaultPlan::kNames; nullopt: any
};

/// Everything that may befall a lidar and its cable, at random times, one after the other, each for
/// a random while.
class FaultPlan {
 public:
  static constexpr std::array<std::string_view, 11> kNames = {
      "noise on the line", "bytes lost",    "bytes repeated",
      "bytes invented",    "unplugged",     "motor stalled",
      "protection stop",   "laser covered", "supply breakdown",
      "stream held up",    "quiet"};

  FaultPlan(replay::EmulatedDevice& device, replay::CoverableScene& scene,
            const FaultConfig& config, std::uint64_t seed);

  /// To be called with each new time.
  void advance(core::TimeNs now_ns);
  /// How often each has happened so far.
  const std::array<std::uint64_t, kNames.size()>& counts() const { return counts_; }

  /// The newest fault that had begun by then, and when; of any thread.
  std::string at(core::TimeNs t_ns) const;

 private:
  struct Fault {
    std::size_t kind = kNames.size();
    core::TimeNs begin_ns = 0;
    core::TimeNs end_ns = 0;  ///< 0: it lasts
  };

  void begin(core::TimeNs now_ns);
  void end(core::TimeNs now_ns);

  replay::EmulatedDevice& device_;
  replay::CoverableScene& scene_;
  FaultConfig config_;
  replay::Random random_;
  core::TimeNs next_ns_ = 0;
  bool is_on_ = false;
  mutable std::mutex mutex_;
  /// The newest ones, in a ring: who asks is a second behind.
  std::array<Fault, 64> faults_{};
  std::uint64_t begun_ = 0;
  std::array<std::uint64_t, kNames.size()> counts_{};
};

}  // namespace cornerd::soak
