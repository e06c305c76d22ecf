// SPDX-License-Identifier: MIT
#pragma once

#include <limits>
#include <optional>

#include "core/geometry/pose2.hpp"
#include "core/types.hpp"

namespace cornerd::core {

/// A robot moves no farther than this between two scans. A place farther off was either wrong or
/// the robot was carried: the next scan tells.
inline constexpr double kJump_m = 0.5;
inline constexpr double kJump_rad = radians(60);

/// Where the lidar should be, and how far off that may be at most.
struct Prior {
  Pose2 T_map_lidar;
  double position_error_m = 0;
  double heading_error_rad = 0;
};

/// Constant-velocity motion model: predicts the next scan's pose from the last two.
class ConstantVelocityModel {
 public:
  /// `motion`: velocity found from the scan itself, used where no earlier pose gives one.
  /// `covariance`: of the pose, m^2 and rad^2. The less certain poses are, the longer the velocity
  /// is averaged (Kalman filter of white noise on acceleration, one for translation and rotation
  /// each).
  void update(const Pose2& T_map_lidar, TimeNs t_ns, const Twist2& motion,
              const Covariance3& covariance);
  void forget();

  /// A prediction by odometry takes precedence: the lidar's pose at the middle of the coming scan,
  /// and whether its samples are deskewed already.
  void set_prediction(const std::optional<Prior>& prior, bool deskewed) {
    expected_ = prior;
    deskewed_ = deskewed;
  }

  /// Predicted pose at `t_ns`; nullopt without a recent pose.
  std::optional<Prior> prior(TimeNs t_ns) const;

  /// Velocity of the lidar in its own axes, from the last two poses; zero where they give none.
  Twist2 motion() const { return deskewed_ ? Twist2{} : motion_; }

  /// True where the last two poses show no motion.
  bool is_stationary() const { return is_stationary_; }

  /// Seconds since the last pose; 0 before the first.
  double age_s(TimeNs t_ns) const {
    return has_pose_ ? to_seconds(t_ns - last_ns_) : std::numeric_limits<double>::infinity();
  }

 private:
  std::optional<Pose2> last_T_map_lidar_;
  TimeNs last_ns_ = 0;
  bool has_pose_ = false;
  std::optional<Prior> expected_;
  bool deskewed_ = false;
  Twist2 motion_;
  double variance_m2_s2_ = 0;  ///< of motion_, per axis
  double variance_rad2_s2_ = 0;
  double sigma_m_ = 0;  ///< of the last pose, per axis
  double sigma_rad_ = 0;
  bool is_stationary_ = false;
};

/// True for speeds that a robot with an A1 reaches.
bool is_plausible(const Twist2& motion);

/// Standard deviations of the velocity by which a scan was deskewed: what it differs from the one
/// `measured` between the last two poses, and 2 %, of robots that drive steadily at 0.1 to 0.5 m/s.
Eigen::Vector3d velocity_sigma(const Twist2& assumed, const Twist2& measured);

/// A pose's covariance after `dt_s` at constant velocity. The velocity is as uncertain as the
/// difference of two such poses one scan of nominal duration apart.
Covariance3 extrapolated_covariance(const Covariance3& covariance, double dt_s);

/// Covariance from deskewing a partial scan of `duration_s` by the velocity of `age_s` ago.
Covariance3 outdated_motion_covariance(double age_s, double duration_s);

/// Transforms a covariance of `lidar` to `base`: their offset rotates with the heading.
Covariance3 covariance_of_base(const Covariance3& of_lidar, const Pose2& T_map_lidar,
                               const Pose2& T_map_base);

}  // namespace cornerd::core
