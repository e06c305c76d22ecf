// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <cstddef>
#include <memory>
#include <optional>
#include <thread>
#include <vector>

#include "calibration/map_faults.hpp"
#include "daemon/localization.hpp"
#include "settings/config.hpp"

namespace cornerd::daemon {

/// Looks for the reason where the map may be wrong, in a thread of its own and of least
/// priority.
class MapExaminer {
 public:
  /// Of the scans that follow.
  void configure(const settings::Config& config);
  void observe(const ScanReport& report);
  /// `is_doubtful`: RecentPoses::doubts_map(). Starts an examination where it is; returns what the
  /// last one found, as long as it is.
  const std::optional<calibration::MapFinding>& update(bool is_doubtful, const core::WallMap* map);

 private:
  void examine(const core::FloorPlan& plan, const std::stop_token& stop);

  settings::Config config_;
  calibration::RecentScans scans_;
  std::size_t added_ = 0;  ///< scans since the last examination
  const core::WallMap* map_ = nullptr;
  std::vector<calibration::ScanSamples> examined_;
  std::optional<calibration::MapFinding> result_;  ///< of the thread, until is_done_
  std::optional<calibration::MapFinding> finding_;
  std::atomic<bool> is_done_{false};
  std::jthread thread_;  ///< last: uses the others
};

}  // namespace cornerd::daemon
