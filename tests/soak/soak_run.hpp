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
  /// Half of a watchdog's ten seconds; see ProgressMonitor.
  double max_stall_s = 5;
  /// Called with each wrong pose: scan, time, estimate, truth and the last fault.
  std::function<void(const std::string& text)> on_wrong;
};

struct SoakReport {
  std::uint64_t scans = 0;
  std::array<std::uint64_t, daemon::ScanPublisher::kStates> poses{};
  std::uint64_t wrong = 0;  ///< poses that are wrong
  double worst_error_m = 0;
  double worst_error_rad = 0;
  std::array<std::uint64_t, FaultPlan::kNames.size()> faults{};
  drivers::StreamCounters counters;
  std::uint64_t read_bytes = 0;  ///< by the port's count
  double simulated_s = 0;
  double real_s = 0;
  double max_without_progress_s = 0;  ///< of both loops, as the watchdog sees it
  std::uint64_t warm_bytes = 0;       ///< on the heap after a tenth of the scans
  std::uint64_t end_bytes = 0;

  /// Failed checks.
  std::vector<std::string> failures(const SoakConfig& config) const;
};

/// Runs the daemon's reader and localizer on an emulated A1 of a driving robot, with the faults of
/// FaultPlan, as fast as possible.
SoakReport run(const SoakConfig& config);

}  // namespace cornerd::soak
