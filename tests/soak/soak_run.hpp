// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "daemon/scan_publisher.hpp"
#include "drivers/lidar_driver.hpp"
#include "fault_plan.hpp"

namespace cornerd::soak {

struct SoakConfig {
  std::uint64_t scans = 2000;
  std::uint64_t seed = 1;
  FaultConfig faults;
  /// Half of what a watchdog of ten seconds allows; see ProgressMonitor.
  double max_stall_s = 5;
  /// Called with each wrong fix: turn, time, estimate and truth, and what had befallen the lidar.
  std::function<void(const std::string& text)> on_wrong;
};

struct SoakReport {
  std::uint64_t scans = 0;
  std::array<std::uint64_t, daemon::ScanPublisher::kStates> poses{};
  std::uint64_t wrong = 0;  ///< fixes that are elsewhere
  double worst_error_m = 0;
  double worst_error_rad = 0;
  std::array<std::uint64_t, FaultPlan::kNames.size()> faults{};
  drivers::StreamCounters counters;
  std::uint64_t read_bytes = 0;  ///< as the port counts them
  double simulated_s = 0;
  double real_s = 0;
  double max_without_progress_s = 0;  ///< of both loops, as the watchdog sees it
  std::uint64_t warm_bytes = 0;       ///< of resident memory, after a tenth of the turns
  std::uint64_t end_bytes = 0;

  /// What does not hold; empty: all is well.
  std::vector<std::string> failures(const SoakConfig& config) const;
};

/// An emulated A1 on a robot that drives, every fault of FaultPlan, and the daemon's own reader and
/// localizer, as fast as they can.
SoakReport run(const SoakConfig& config);

}  // namespace cornerd::soak
