// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "core/geometry/pose2.hpp"
#include "core/types.hpp"

namespace cornerd::core {

/// Where the lidar should be, and how far from there it may have come meanwhile.
struct Prior {
  Pose2 T_map_lidar;
  double place_m = 0;
  double heading_rad = 0;
};

/// The last poses of the lidar, and what they say of the next turn.
class PoseMemory {
 public:
  /// `motion`: that the turn itself showed, which counts where no pose before tells better.
  void remember(const Pose2& T_map_lidar, TimeNs t_ns, const Twist2& motion);
  void forget();

  /// What odometry knows of the turn to come goes before what the last poses say: where the lidar
  /// should be in its middle, and that its samples have been moved there already.
  void expect(const std::optional<Prior>& prior, bool straightened) {
    expected_ = prior;
    straightened_ = straightened;
  }

  /// Where the lidar should be by now; nullopt where nothing recent is known.
  std::optional<Prior> prior(TimeNs t_ns) const;

  /// Of the lidar, in its own axes, from the last two poses; rest where they do not tell.
  Twist2 motion() const { return straightened_ ? Twist2{} : motion_; }

  /// True where the last two poses show a robot that did not move between them.
  bool stands() const { return stands_; }

  /// Seconds since the last pose; 0 before the first.
  double age_s(TimeNs t_ns) const { return ever_ ? to_seconds(t_ns - last_ns_) : 0; }

 private:
  std::optional<Pose2> last_T_map_lidar_;
  TimeNs last_ns_ = 0;
  bool ever_ = false;
  std::optional<Prior> expected_;
  bool straightened_ = false;
  Twist2 motion_;
  bool stands_ = false;
};

/// True where a robot that needs an A1 may move like this.
bool is_plausible(const Twist2& motion);

/// What is left of the motion within a turn after its samples were moved back by `used`: the robot
/// does not keep its speed to the end (2 % of half a turn's way makes the covariance of steady
/// drives at 0.1 to 0.5 m/s no smaller than their errors), and where the way from the pose before
/// says another motion, `seen`, it changed its speed in between.
Covariance3 doubt_of_motion(const Twist2& used, const Twist2& seen);

/// A pose's covariance `dt_s` later, where nothing but the robot's own inertia tells its way: the
/// speed is known as well as two such poses, a usual turn apart, tell it.
Covariance3 later(const Covariance3& covariance, double dt_s);

/// What samples of half of `duration_s` ago are off, seen from now, where the motion that they are
/// moved by was that of `age_s` ago: robots speed up and slow down.
Covariance3 doubt_of_old_motion(double age_s, double duration_s);

/// A covariance of `lidar` becomes that of `base`: the offset between them turns with the heading.
Covariance3 covariance_of_base(const Covariance3& of_lidar, const Pose2& T_map_lidar,
                               const Pose2& T_map_base);

}  // namespace cornerd::core
