// SPDX-License-Identifier: MIT
// Faults of wheels, gyro and lidar mount: a bank of hypotheses, each with its posterior.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "calibration/motion_window.hpp"
#include "core/geometry/pose2.hpp"
#include "core/odometry/odometry_config.hpp"

namespace cornerd::calibration {

/// How the counts of the two fields of ODOMETRY belong to the wheels. `left` is what the left
/// wheel's counts are: the left (0) or the right (1) field, with its sign.
struct Wiring {
  bool is_swapped = false;
  bool left_is_reversed = false;  ///< of the left field
  bool right_is_reversed = false;

  bool operator==(const Wiring&) const = default;
};

enum class DriveFault : std::uint8_t {
  kNone,
  kWiring,      ///< fields swapped or reversed; possibly with wrong counts, too
  kCounts,      ///< counts_per_turn, or wheel_radius
  kLeftCounts,  ///< of the left field alone
  kRightCounts,
  kTrack,
  kLeftUnrelated,  ///< the left field does not tell the motion of the wheel: a dead encoder
  kRightUnrelated,
  kBothUnrelated,   ///< or several faults at once
  kDelay,           ///< the times of the readings
  kMountTurned,     ///< lidar.mount.theta
  kMountDisplaced,  ///< lidar.mount.x, .y
  kMountBoth,
};

enum class GyroFault : std::uint8_t {
  kNone,
  kReversed,
  kDegrees,
  kDegreesReversed,
  kFactor,
  kBias,
  kDelay,      ///< the times of the readings
  kStuck,      ///< it repeats its value
  kUnrelated,  ///< another axis
};

/// One hypothesis that the motion does not contradict.
struct DriveHypothesis {
  DriveFault fault = DriveFault::kNone;
  Wiring wiring{};
  double posterior = 0;
  double factor =
      1;  ///< true over counted distance: of both wheels, or of the one that `fault` names
  double track_m = 0;          ///< kTrack: the true one
  core::Pose2 T_base_lidar{};  ///< estimated
  core::Pose2 sigma{};         ///< of T_base_lidar
  double delay_s = 0;          ///< kDelay: how late the times of the readings are
  bool is_silent = false;      ///< unrelated: the counts do not change
  bool is_copy = false;        ///< unrelated: the counts are those of the other wheel
  double reduced_chi_square = 0;
};

struct GyroHypothesis {
  GyroFault fault = GyroFault::kNone;
  double posterior = 0;
  double factor = 1;      ///< measured over true rate
  double bias_rad_s = 0;  ///< of the readings as they are
  double delay_s = 0;
};

/// Hypotheses by posterior, best first. A fault is named where kNone has less than kMaxPosterior;
/// then all that the data cannot tell apart are, if the best accounts for the motion.
struct DriveFaults {
  /// Of "nothing is wrong" where something is.
  static constexpr double kMaxPosterior = 1e-3;
  /// Relative to the best: less is told apart.
  static constexpr double kMinRatio = 0.02;

  /// Of the best hypothesis: its sigmas are upper bounds, so that 180 residuals of a robot that it
  /// describes have less (mean + 2 sigma). Others are kBothUnrelated.
  static constexpr double kMaxReducedChiSquare = 1.2;

  std::vector<DriveHypothesis> drive;  ///< those that cannot be told apart; empty: nothing is wrong
  std::vector<GyroHypothesis> gyro;
  /// The mount by a fit with right wheels; its sigmas are infinite where the data do not show it.
  DriveHypothesis mount;

  bool any() const { return !drive.empty() || !gyro.empty(); }
};

/// `T_base_lidar`: the configured mount; `geometry`: by which the windows' distances were counted.
/// Where the mount is not known, the best hypothesis need not account for the motion.
DriveFaults find_drive_faults(std::span<const MotionWindow> windows,
                              const core::Pose2& T_base_lidar, const core::DriveGeometry& geometry,
                              bool mount_is_known = true);

}  // namespace cornerd::calibration
