// SPDX-License-Identifier: MIT
#include "daemon/fault_list.hpp"

#include <cstddef>
#include <utility>

namespace cornerd::daemon {
namespace {

/// Of the recent scans: in a map of another place hardly any scan has a pose, whereas among
/// furniture and people that hide half of the walls some always have one.
constexpr std::size_t kMinLost = ScanPublisher::kRecentScans * 95 / 100;

std::string lost_hint(const ScanPublisher& scans) {
  const std::string name = scans.map() != nullptr ? scans.map()->plan().name : std::string();
  return std::to_string(scans.recently_lost()) + " of the last " +
         std::to_string(ScanPublisher::kRecentScans) + " scans fit nowhere in the map \"" + name +
         "\": check that it is the map of this place (not mirrored, in metres), that the robot is "
         "inside it, and lidar.mount.inverted";
}

}  // namespace

FaultList::FaultList(const drivers::LidarStatus& lidar, const ScanPublisher& scans,
                     const std::optional<calibration::MapFinding>& map,
                     const message::StatusFields& status, const calibration::DriveFaults& drive,
                     const calibration::OdometryNames& names) {
  if (lidar.fault != drivers::LidarFault::kNone) {
    add(drivers::to_string(lidar.fault), std::string(lidar.detail.view()));
  }
  const bool is_mostly_lost = scans.recently_lost() >= kMinLost;
  if (map && (is_mostly_lost || map->fault != calibration::MapFault::kNoVariant)) {
    add(calibration::name_of(*map), calibration::describe(*map, scans.map()->plan().name));
  } else if (is_mostly_lost) {
    add("map-mismatch", lost_hint(scans));
  }
  for (const std::string_view name : calibration::names_of(drive)) {
    add(name, calibration::describe(drive, names));
  }
  if (!drive.any() && scans.odometry().present && !scans.odometry().healthy) {
    add("odometry-unhealthy",
        "the odometry contradicts the lidar and is not used: drive a minute, straight and with "
        "rotations both ways, and the reason is named here");
  }
  if (!status.odometry_hint.empty()) {
    add(status.odometry_is_refused ? "odometry-refused" : "odometry-absent",
        std::string(status.odometry_hint));
  }
}

void FaultList::add(std::string_view name, std::string hint) {
  if (names_.empty()) hint_ = std::move(hint);
  names_.push_back(name);
}

}  // namespace cornerd::daemon
