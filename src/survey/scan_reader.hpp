// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>

#include "core/localizer_config.hpp"
#include "core/odometry/odometer.hpp"
#include "core/polar_scan.hpp"
#include "core/scan.hpp"
#include "survey/recorded_drive.hpp"

namespace cornerd::survey {

/// Predicted pose of a scan.
struct ScanPrior {
  core::Pose2 T_map_lidar;
  core::Covariance3 covariance = core::Covariance3::Zero();
  core::Pose2 T_before_now;  ///< predicted motion since the scan before
  double sigma_m = 0;        ///< of that motion
  double sigma_rad = 0;
  bool by_odometry = false;
  /// After a pause without scans and without odometry.
  bool after_pause = false;
};

/// Reads a drive scan by scan: each deskewed to its middle, with a predicted pose. Odometry gives
/// both where it is recorded, and is calibrated by the poses that the survey finds. Otherwise the
/// motion between the poses of earlier scans does.
class ScanReader {
 public:
  /// `learned`: the odometry's calibration by an earlier pass.
  /// `earlier_poses`: of all scans by an earlier pass, for a drive without odometry; may be empty.
  /// `unmatched`: indices of the scans that the earlier pass did not match, ascending.
  ScanReader(const RecordedDrive& drive, const core::LocalizerConfig& config,
             const std::optional<core::OdometryParameters>& learned,
             std::span<const core::Pose2> earlier_poses, std::span<const std::size_t> unmatched);

  /// Advances to the next scan; false after the last one.
  bool next();
  std::size_t scan() const { return index_; }
  const core::PolarScan& points() const { return points_; }
  const ScanPrior& prior() const { return prior_; }

  /// Without odometry: deskews the scan by the motion from the scan before to `T_map_lidar`.
  /// Returns false, without effect, where odometry or an earlier pass gives the motion.
  bool deskew_again(const core::Pose2& T_map_lidar);

  /// Sets the pose of the current scan, before next(). Unmatched scans without odometry may be left
  /// out; the next ones are then predicted from the last known pose.
  void place(const core::Pose2& T_map_lidar, const core::Covariance3& covariance);

  core::OdometryParameters learned() const { return odometer_.summary().parameters; }
  /// The odometry has lately been inconsistent with the lidar.
  bool is_contradicted() const;
  core::OdometryCounters counters() const { return odometer_.summary().counters; }

 private:
  void add_readings();
  void predict(core::TimeNs t_ns);
  bool is_after_pause() const;
  bool is_known(std::size_t scan) const;
  core::Twist2 expected_motion() const;
  core::Twist2 motion_to(const core::Pose2& T_map_lidar) const;
  void deskew(const core::Twist2& motion);

  const RecordedDrive& drive_;
  core::LocalizerConfig config_;
  core::Pose2 T_lidar_base_;
  std::span<const core::Pose2> earlier_poses_;
  std::span<const std::size_t> unmatched_;
  core::Odometer odometer_;
  std::size_t next_reading_ = 0;
  bool has_gyro_ = false;
  std::uint64_t gaps_ = 0;  ///< in the odometry, up to the scan before
  core::TimeNs last_reading_ns_ = std::numeric_limits<core::TimeNs>::min();

  bool started_ = false;
  std::size_t index_ = 0;
  core::Scan scan_;
  core::Scan still_;
  core::PolarScan points_;
  ScanPrior prior_;

  core::TimeNs last_ns_ = 0;  ///< of the last scan with a pose
  std::size_t last_scan_ = 0;
  core::Pose2 last_T_map_lidar_;
  core::Twist2 last_motion_;
  core::Pose2 filtered_T_map_lidar_;  ///< the odometer's estimate of that pose
};

}  // namespace cornerd::survey
