// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "core/scan.hpp"
#include "tool/replay/truth.hpp"

namespace cornerd::tool {

/// The returns of a drive, kept until their poses are known.
class DrivePoints {
 public:
  /// `T_map_base`: in the middle of the scan; nullopt if unknown.
  void add(const core::Scan& scan, const std::optional<core::Pose2>& T_map_base);

  /// Points in the map of all scans with a pose, interpolated to the neighbouring scan's if near.
  std::vector<core::Vec2> place(const core::Pose2& T_base_lidar) const;

  /// Points of all returns at times that `trajectory` covers.
  std::vector<core::Vec2> place(const core::Pose2& T_base_lidar, const Truth& trajectory) const;

 private:
  struct RecordedScan {
    core::TimeNs middle_ns = 0;
    std::optional<core::Pose2> T_map_base;
    std::vector<core::Sample> returns;
  };
  /// The pose at a time during a scan with a pose.
  core::Pose2 pose_at(std::size_t scan, core::TimeNs t_ns) const;

  std::vector<RecordedScan> scans_;
};

/// One point for each square of `cell_m`, within the two corners.
std::vector<core::Vec2> thin_out(const std::vector<core::Vec2>& points, double cell_m,
                                 const core::Vec2& low, const core::Vec2& high);

}  // namespace cornerd::tool
