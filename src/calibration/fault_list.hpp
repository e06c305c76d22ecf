// SPDX-License-Identifier: MIT
#pragma once

#include <bitset>
#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "calibration/drive_fault_text.hpp"
#include "calibration/map_faults.hpp"
#include "core/map/wall_map.hpp"
#include "core/odometry/odometry_summary.hpp"
#include "core/scan.hpp"
#include "core/scan_result.hpp"

namespace cornerd::calibration {

/// More than a metre from the box around the map's walls: further out than in front of a door.
bool is_outside(const core::WallMap& map, const core::Vec2& place);

/// Of the newest scans in one map: about 15 s of an A1.
class RecentPoses {
 public:
  static constexpr std::size_t kScans = 100;

  /// Returns nearer and farther than these are not used.
  struct Limits {
    double min_range_m = 0;
    double max_range_m = std::numeric_limits<double>::infinity();
  };

  /// `map`: null where it is not known which of several maps the robot is in.
  void add(const core::ScanResult& result, const core::Scan& scan, const Limits& limits,
           const core::WallMap* map);
  /// That fit nowhere, whether or not odometry carried the pose on.
  std::size_t lost() const { return lost_.count(); }
  /// The map may be wrong: many scans fit nowhere, or poses are not where odometry leads.
  bool doubts_map() const;
  /// Lost, or at several places.
  std::size_t unnamed() const { return (lost_ | ambiguous_).count(); }
  /// That have no pose, and whose returns are mostly beyond the limits. Who cuts a hall on purpose
  /// has poses.
  std::size_t cut() const { return cut_.count(); }
  std::size_t outside() const { return outside_.count(); }
  /// At several places.
  std::size_t ambiguous() const { return ambiguous_.count(); }
  /// That show hardly a wall, and have no pose.
  std::size_t blank() const { return blank_.count(); }
  /// In which the odometry contradicts the lidar.
  std::size_t contradicted() const { return contradicted_.count(); }
  /// Of the scans of the last minute, that fit nowhere.
  std::size_t lost_in_a_minute() const { return lost_in_a_minute_.count(); }
  static constexpr std::size_t kScansOfAMinute = 440;

 private:
  std::bitset<kScans> lost_;  ///< newest first
  std::bitset<kScans> ambiguous_;
  std::bitset<kScans> cut_;
  std::bitset<kScans> outside_;
  std::bitset<kScans> blank_;
  std::bitset<kScans> contradicted_;
  std::bitset<kScansOfAMinute> lost_in_a_minute_;
};

/// What is wrong between lidar and pose, in the order of weight: the faults of STATUS, and a hint
/// for a person about the first.
class FaultList {
 public:
  void add(std::string_view name, std::string hint);
  /// Of the scans in `plan`, which is null where it is not known which of several maps the robot is
  /// in.
  void add_map(const std::optional<MapFinding>& finding, const RecentPoses& recent,
               const core::FloorPlan* plan);
  /// `names`: of the remedies of `drive`.
  void add_drive(const DriveFaults& drive, const OdometryNames& names, const RecentPoses& recent,
                 const core::OdometrySummary& odometry);

  std::span<const std::string_view> names() const { return names_; }
  /// One sentence; empty if there is no fault.
  const std::string& hint() const { return hint_; }

 private:
  std::vector<std::string_view> names_;
  std::string hint_;
};

}  // namespace cornerd::calibration
