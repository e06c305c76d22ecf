// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "core/scan.hpp"
#include "tool/replay/truth.hpp"

namespace cornerd::tool {

/// The returns of a drive, scan by scan, until it is known where each was taken from.
class DrivePoints {
 public:
  /// `T_map_base`: in the middle of the scan, where that is known.
  void add(const core::Scan& scan, const std::optional<core::Pose2>& T_map_base);

  /// Of the scans whose place is known, in the map: each return from where the robot was between
  /// this scan and the next to it, unless that one is long ago.
  std::vector<core::Vec2> place(const core::Pose2& T_base_lidar) const;

  /// Of all scans: each return from where `way` has the robot, none where it says nothing.
  std::vector<core::Vec2> place(const core::Pose2& T_base_lidar, const Truth& way) const;

 private:
  struct RecordedScan {
    core::TimeNs middle_ns = 0;
    std::optional<core::Pose2> T_map_base;
    std::vector<core::Sample> returns;
  };
  /// Where the robot was at a time of a scan whose place is known.
  core::Pose2 pose_at(std::size_t scan, core::TimeNs t_ns) const;

  std::vector<RecordedScan> scans_;
};

/// One of the points that share a square of `cell_m`, of those within the two corners.
std::vector<core::Vec2> thin_out(const std::vector<core::Vec2>& points, double cell_m,
                                 const core::Vec2& low, const core::Vec2& high);

}  // namespace cornerd::tool
