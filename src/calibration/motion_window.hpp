// SPDX-License-Identifier: MIT
// The motion of a robot over about a second, by its lidar, its wheels and its gyro.
#pragma once

#include <array>
#include <cstddef>
#include <deque>
#include <optional>
#include <span>
#include <vector>

#include "calibration/drive_window.hpp"
#include "core/geometry/pose2.hpp"
#include "core/odometry/odometry_increment.hpp"

namespace cornerd::calibration {

/// What the counts and the gyro say of a window.
struct CountedMotion {
  double left_m = 0;  ///< by the configured geometry
  double right_m = 0;
  double gyro_rad = 0;

  void extend(const core::OdometryIncrement& step);
};

/// By how much the times of the readings may be late. A delay between two of them changes a window
/// by less than its noise.
inline constexpr std::array<double, 7> kDelays_s = {0, -0.15, 0.15, -0.3, 0.3, -0.45, 0.45};
/// Of these many, from the first, the filter's estimate of the delay takes care.
inline constexpr std::size_t kHarmlessDelays = 3;

/// Sums over the scans of a window. With T_base_lidar = (x, y, theta), and no slip sideways:
///     cos(theta) lidar.x - sin(theta) lidar.y + y sine = translation of the base
///     sin(theta) lidar.x + cos(theta) lidar.y - x sine = 0
/// They are the hand-eye relation A X = X B in the plane, each scan's turned by half of its
/// rotation.
struct MotionWindow {
  /// Translation of the lidar from scan to scan, turned by minus half of the rotation; lidar frame.
  core::Vec2 lidar_m = core::Vec2::Zero();
  double sine = 0;          ///< 2 sin(rotation / 2), summed
  double rotation_rad = 0;  ///< of the lidar, not wrapped
  bool has_gyro = true;
  bool gyro_is_stuck = false;  ///< it repeats its value while the wheels turn
  double duration_s = 0;
  std::array<CountedMotion, kDelays_s.size()> counted{};  ///< for each delay

  /// Adds the lidar's motion from one scan to the next.
  void extend(const core::Pose2& T_from_to);
  /// By lidar or wheels.
  bool has_motion() const;
};

/// Cuts windows from odometry increments and the lidar's poses, each in the order of time. A window
/// with a gap in either is dropped, be it within the longest delay, and one with a jump of the
/// pose. Keeps the newest windows in which the robot moved.
class MotionWindows {
 public:
  explicit MotionWindows(std::size_t capacity) : capacity_(capacity) {}

  void add(const core::OdometryIncrement& step);
  void add(core::TimeNs t_ns, const core::Pose2& T_map_lidar);
  /// The next pose is no motion from the last.
  void interrupt() { is_interrupted_ = true; }
  void clear() { windows_.clear(); }

  const std::deque<MotionWindow>& windows() const { return windows_; }
  /// How many there have been.
  std::size_t count() const { return count_; }

 private:
  struct Pose {
    core::TimeNs t_ns = 0;
    core::Pose2 T_map_lidar;
    bool is_first = false;  ///< after an interruption
  };

  void advance();
  void extend_to(const Pose& pose);
  /// Adds the odometry of the time, for each delay; false where some of it is missing.
  bool extend_by_odometry(core::TimeNs from_ns, core::TimeNs to_ns);
  void begin_at(const Pose& pose);

  std::size_t capacity_;
  std::deque<core::OdometryIncrement> steps_;  ///< that a window may need
  std::deque<Pose> poses_;                     ///< that wait for increments
  bool is_interrupted_ = false;                ///< since the last of them
  std::optional<Pose> last_;                   ///< the window in progress ends here
  core::TimeNs begin_ns_ = 0;
  MotionWindow window_;
  std::deque<MotionWindow> windows_;
  std::size_t count_ = 0;
};

/// All windows of a recorded drive. `T_base_lidar`: of the config that gave the places.
std::vector<MotionWindow> motion_windows(std::span<const core::OdometryIncrement> steps,
                                         std::span<const KnownPose> places,
                                         const core::Pose2& T_base_lidar);

}  // namespace cornerd::calibration
