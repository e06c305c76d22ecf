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

/// Which faults, how often, how long.
struct FaultConfig {
  double mean_pause_s = 8;  ///< between faults: long enough to localize again
  double max_duration_s = 6;
  std::optional<std::size_t> only;  ///< index into FaultPlan::kNames; nullopt: any
};

/// Faults of a lidar and its cable, one at a time, at random times and of random duration.
class FaultPlan {
 public:
  static constexpr std::array<std::string_view, 11> kNames = {
      "noise on the line", "bytes lost",    "bytes repeated",
      "bytes invented",    "unplugged",     "motor stalled",
      "protection stop",   "laser covered", "supply breakdown",
      "stream held up",    "quiet"};

  FaultPlan(replay::EmulatedDevice& device, replay::CoverableScene& scene,
            const FaultConfig& config, std::uint64_t seed);

  /// Call with each new time.
  void advance(core::TimeNs now_ns);
  /// Number of each fault so far.
  const std::array<std::uint64_t, kNames.size()>& counts() const { return counts_; }

  /// The newest fault that had begun by `t_ns`, as text. Any thread.
  std::string at(core::TimeNs t_ns) const;

 private:
  struct Fault {
    std::size_t kind = kNames.size();
    core::TimeNs begin_ns = 0;
    core::TimeNs end_ns = 0;  ///< 0: still active
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
  /// Ring of the newest faults, as callers of at() are a second behind.
  std::array<Fault, 64> faults_{};
  std::uint64_t begun_ = 0;
  std::array<std::uint64_t, kNames.size()> counts_{};
};

}  // namespace cornerd::soak
