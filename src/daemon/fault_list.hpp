// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "calibration/drive_fault_text.hpp"
#include "calibration/map_faults.hpp"
#include "daemon/scan_publisher.hpp"
#include "drivers/lidar_driver.hpp"

namespace cornerd::daemon {

/// What is wrong between lidar and pose, in the order of weight: the faults of STATUS, and a hint
/// for a person about the first.
class FaultList {
 public:
  /// `status`: with what the odometry's source says of itself; `names`: of the remedies of `drive`.
  FaultList(const drivers::LidarStatus& lidar, const ScanPublisher& scans,
            const std::optional<calibration::MapFinding>& map, const message::StatusFields& status,
            const calibration::DriveFaults& drive, const calibration::OdometryNames& names);

  std::span<const std::string_view> names() const { return names_; }
  /// One sentence; empty if there is no fault.
  const std::string& hint() const { return hint_; }

 private:
  void add(std::string_view name, std::string hint);

  std::vector<std::string_view> names_;
  std::string hint_;
};

}  // namespace cornerd::daemon
