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

/// Where the lidar should be in a turn by what was known before it.
struct ScanPrior {
  core::Pose2 T_map_lidar;
  core::Covariance3 covariance = core::Covariance3::Zero();
  core::Pose2 T_before_now;  ///< the way from the turn before, as far as it was foreseen
  double sigma_m = 0;        ///< of that way
  double sigma_rad = 0;
  bool by_odometry = false;
  /// After a pause in which neither turns nor readings say how the robot moved.
  bool after_pause = false;
};

/// Goes through a drive turn by turn: each as a lidar that stood still in its middle would have
/// seen it, with a prediction of where that was. Wheels and gyro tell both where there are any, and
/// learn from the poses that the survey finds; else the way from pose to pose does.
class ScanReader {
 public:
  /// `learned`: of wheels and gyro, by a reader that went before.
  /// `known_poses`: of all turns by an earlier pass, for a drive without odometry; may be empty.
  /// `guessed`: the turns whose pose that pass did not find, in their order.
  ScanReader(const RecordedDrive& drive, const core::LocalizerConfig& config,
             const std::optional<core::LearnedOdometry>& learned,
             std::span<const core::Pose2> known_poses, std::span<const std::size_t> guessed);

  /// Goes on to the next turn; false after the last one.
  bool next();
  std::size_t scan() const { return index_; }
  const core::PolarScan& points() const { return points_; }
  const ScanPrior& prior() const { return prior_; }

  /// Where nothing but the lidar tells how it moved in this turn: straightens the turn by the way
  /// from the one before to where this one seems to have been. Else does nothing, and says false.
  bool straighten_again(const core::Pose2& T_map_lidar);

  /// Where the lidar was; to be said before the next turn. Of a turn without odometry that is not
  /// known it may stay unsaid: the next ones are then foreseen from the last that was.
  void place(const core::Pose2& T_map_lidar, const core::Covariance3& covariance);

  core::LearnedOdometry learned() const { return odometer_.summary().learned; }
  /// Wheels and lidar have lately told different stories.
  bool is_contradicted() const;
  core::OdometryCounters counters() const { return odometer_.summary().counters; }

 private:
  void hear_readings();
  void predict(core::TimeNs t_ns);
  bool is_after_pause() const;
  bool is_known(std::size_t scan) const;
  core::Twist2 expected_motion() const;
  core::Twist2 motion_to(const core::Pose2& T_map_lidar) const;
  void straighten(const core::Twist2& motion);

  const RecordedDrive& drive_;
  core::LocalizerConfig config_;
  core::Pose2 T_lidar_base_;
  std::span<const core::Pose2> known_poses_;
  std::span<const std::size_t> guessed_;
  core::Odometer odometer_;
  std::size_t next_reading_ = 0;
  bool has_gyro_ = false;
  std::uint64_t holes_ = 0;  ///< in the odometry, up to the turn before
  core::TimeNs heard_ns_ = std::numeric_limits<core::TimeNs>::min();

  bool begun_ = false;
  std::size_t index_ = 0;
  core::Scan scan_;
  core::Scan still_;
  core::PolarScan points_;
  ScanPrior prior_;

  core::TimeNs last_ns_ = 0;  ///< of the last turn that was placed
  std::size_t last_scan_ = 0;
  core::Pose2 last_T_map_lidar_;
  core::Twist2 last_motion_;
  core::Pose2 filtered_T_map_lidar_;  ///< what the odometer made of it
};

}  // namespace cornerd::survey
