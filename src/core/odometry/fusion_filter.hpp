// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>

#include <Eigen/Core>

#include "core/odometry/jitter_meter.hpp"
#include "core/odometry/noise_learning.hpp"
#include "core/odometry/odometry_config.hpp"
#include "core/odometry/odometry_increment.hpp"
#include "core/odometry/pull_watch.hpp"
#include "core/odometry/slip_watch.hpp"
#include "core/odometry/usual_motion.hpp"

namespace cornerd::core {

class Cholesky3;

/// An extended Kalman filter over the pose of `base` in `map` and OdometryParameters. Wheels move
/// it, the gyro corrects the turn of each step, the lidar's fixes correct all of it. The pose is
/// that of a reading's time; a fix is of the lidar's, which is the same less the delay, and what
/// the delay is off by shows in fixes as the way that the robot makes meanwhile. Fixed size, no
/// allocation.
class FusionFilter {
 public:
  /// kLeftRest, kRightRest: metres that a wheel has rolled beyond the middle of its count.
  enum Index : std::uint8_t {
    kX,
    kY,
    kTheta,
    kBias,
    kLeft,
    kRight,
    kTrack,
    kGyro,
    kLeftRest,
    kRightRest,
    kDelay,
    kSize
  };
  using Vector = Eigen::Matrix<double, kSize, 1>;
  using Matrix = Eigen::Matrix<double, kSize, kSize>;

  explicit FusionFilter(const OdometryConfig& config);

  /// Moves the pose on by what wheels and gyro did.
  void predict(const OdometryIncrement& step);

  /// How fast `base` moves now: what makes an unknown delay an unknown place.
  void set_velocity(double speed_m_s, double rate_rad_s);

  /// Whether the gyro is known to be right, so that what differs from it is a wheel that slips.
  void believe_gyro(bool believed) { gyro_is_believed_ = believed; }

  /// The readings' times are those of another clock from now on.
  void doubt_times();

  /// Forgets what was learned, and the pose: begins with these as at first.
  void start_from(const OdometryParameters& start);

  /// Forgets the pose alone, and takes this one; what was learned stays.
  void set_pose(const Pose2& T_map_base, const Covariance3& covariance);

  /// How far a pose that the lidar gave for the time reached is from the filter's: x, y, theta.
  Eigen::Vector3d surprise_of(const Pose2& T_map_base) const;
  /// False where it is too far off to belong to the same drive.
  bool explains(const Pose2& T_map_base, const Covariance3& covariance) const;
  /// Takes it in, the covariance as it is. False, and nothing changed, where it is not explained.
  bool correct(const Pose2& T_map_base, const Covariance3& covariance);

  /// What was driven since the last fix.
  struct Stretch {
    double rolled_m = 0;  ///< by each wheel, the mean of both
    double rotated_rad = 0;
    double duration_s = 0;
    Vec2 start = Vec2::Zero();
  };
  const Stretch& since_fix() const { return since_fix_; }
  /// How far from the last fix the robot is; metres.
  double way_since_fix_m() const { return (pose().translation() - since_fix_.start).norm(); }
  /// Makes the pose less sure.
  void doubt_pose(const Covariance3& more) { covariance_.topLeftCorner<3, 3>() += more; }

  Pose2 pose() const { return {state_[kX], state_[kY], state_[kTheta]}; }
  /// Of the pose as the lidar sees it: with what the delay is off by, and more of that than the
  /// filter knows of.
  Covariance3 pose_covariance(double more_delay_s2 = 0) const;
  OdometryParameters learned() const;
  const Vector& state() const { return state_; }
  const Matrix& covariance() const { return covariance_; }

  /// The turn of `base` in a step by what is known now, and the way.
  Pose2 motion_of(const OdometryIncrement& step) const;

  /// Steps in which the wheels' turn could not be the gyro's: slip, or a frozen encoder.
  std::uint64_t slips() const { return slips_; }

  /// True where wheels and gyro have lately contradicted each other most of the time.
  bool is_contradictory() const { return slip_watch_.is_contradiction(); }

  /// Variances of what wheels, or wheels and gyro, wander on such a way.
  struct Wander {
    double place_m2 = 0;
    double rotation_variance = 0;
  };
  Wander wander_of(const Pose2& way, double duration_s, bool has_gyro) const;

  /// How much more or less than told wheels and gyro wander, as learned from the fixes.
  const NoiseLearning& noise() const { return learning_; }

 private:
  /// A tyre is no line: where it touches the floor wanders with every turn on the spot.
  static constexpr double kScrub_rad_per_sqrt_rad = 0.001;

  using Row = Eigen::RowVector<double, kSize>;
  struct Prediction;
  // The steps of predict().
  Prediction by_wheels(const OdometryIncrement& step) const;
  void expect_of_gyro(Prediction& p) const;
  void compare_with_gyro(Prediction& p);
  void move_on(const Prediction& p);
  /// How the wheels' turn, and what the gyro says of it, change with the state.
  Row turn_slope(double way_m, double rotation_rad, bool rolls) const;
  Row seen_slope(const Row& turn_by, double rotation_rad, double dt_s) const;
  double variance_along(const Row& slope) const;
  /// x, y, theta a second.
  Eigen::Vector3d velocity() const;
  /// The covariance of the pose as the lidar sees it with the state.
  Eigen::Matrix<double, 3, kSize> seen_with_state() const;
  void predict_hole(const OdometryIncrement& step);
  /// Doubts anew what the fixes pull to one side. `root`: of the surprise's covariance.
  void watch_pulls(const Cholesky3& root, const Eigen::Vector3d& surprise);
  void keep_in_bounds();

  DriveGeometry geometry_;
  OdometryNoise noise_;
  Vector state_ = Vector::Zero();
  Matrix covariance_ = Matrix::Zero();
  NoiseLearning learning_;
  UsualMotion usual_;
  Stretch since_fix_;
  JitterMeter jitter_;
  SlipWatch slip_watch_;
  std::array<PullWatch, kSize> pulls_;
  bool gyro_is_believed_ = true;
  double speed_m_s_ = 0;
  double rate_rad_s_ = 0;
  std::uint64_t slips_ = 0;
};

}  // namespace cornerd::core
