// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <utility>

#include <Eigen/Core>

#include "core/geometry/linear_solve.hpp"
#include "core/geometry/pose2.hpp"
#include "core/odometry/motion_factor.hpp"
#include "core/odometry/noise_estimator.hpp"
#include "core/odometry/odometry_config.hpp"
#include "core/odometry/odometry_increment.hpp"
#include "core/odometry/slip_rate.hpp"

namespace cornerd::core {

/// Rotation in a scan, measured twice.
struct RotationComparison {
  double wheel_rad = 0;
  double gyro_rad = 0;
  double variance = 0;  ///< of their difference by noise; 0: there is none
};

/// An extended Kalman filter over the pose of `base` in `map` and the calibration, a slow random
/// walk: gyro bias b, wheel scales l and r, track scale t, gyro scale g, the wheels' positions
/// within their counts, and the delay of the readings. Predicted once a scan by a MotionFactor; a
/// fix of the lidar is a measurement of the pose at its own time. Process and measurement noise
/// adapt to the innovations (NoiseBank). Fixed size, no allocation. Metres, radians, seconds.
class MotionFilter {
 public:
  /// Of the sensors' noise over a scan, the share in the fix of a scan that is deskewed by them: a
  /// sample between the middle and the end is off by a quarter of that variance, all together by a
  /// twelfth; between them by NEES of fixes (`cornerd-bench --odometry`).
  static constexpr double kDeskewNoiseShare = 0.3;
  /// What a robot may do in a time of which nothing is known.
  static constexpr double kUnknown_m_s = 0.5;
  static constexpr double kUnknown_rad_s = 1.5;

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

  explicit MotionFilter(const OdometryConfig& config);

  /// Takes an increment that begins where the last one ended. advance() predicts by them.
  void add(const OdometryIncrement& step);
  /// Predicts the state to the end of the last increment; the wheels' rotation is a second
  /// measurement of the gyro's.
  void advance();

  /// A time of the lidar relative to the filter: `lead_s` after the end of the last increment by
  /// the estimated delay, negative before it; `velocity` of `base` then.
  struct Epoch {
    double lead_s = 0;
    Twist2 velocity;
    /// The scan then is deskewed by the filter's own sensors.
    bool is_deskewed = false;
  };
  Pose2 pose_at(const Epoch& epoch) const;
  /// Of pose_at(), with the delay's uncertainty and the jitter of the readings' times.
  Covariance3 covariance_at(const Epoch& epoch) const;

  /// Starts from this pose; the calibration stays.
  void set_pose(const Pose2& T_map_base, const Covariance3& covariance, const Epoch& epoch);
  /// Updates the state by a fix. False, and nothing changed, where its NIS is one that a true fix
  /// exceeds once in a million.
  bool correct(const Pose2& T_map_base, const Covariance3& covariance, const Epoch& epoch);

  /// The times of the readings are those of another clock from now on.
  void doubt_times();

  /// As estimated. `slip_share`: of the mean square of slips.
  MotionNoise noise(double slip_share) const;

  OdometryParameters parameters() const;
  /// False where the scale of a wheel is one that no setting that is right could need. (A tracked
  /// vehicle turns as one of nearly twice its track.)
  bool is_in_bounds() const;
  OdometryParameters sigma() const;
  Pose2 pose() const { return {state_[kX], state_[kY], state_[kTheta]}; }
  const Matrix& covariance() const { return covariance_; }
  /// Variance of a time between two readings, s^2.
  double jitter_s2() const { return jitter_s2_; }
  /// The wheels' rotation against the gyro's in the last advance() that had both.
  RotationComparison take_comparison() { return std::exchange(rotations_, {}); }
  /// The rotation is the gyro's.
  bool has_gyro() const { return has_gyro_; }
  /// Scans in which the wheels' rotation was not the gyro's.
  std::uint64_t slips() const { return slips_; }

 private:
  /// Slips are rare and large: a covariance with their mean square is exceeded by each of them.
  static constexpr double kSlipTail = 4;

  using Measurement = Eigen::Matrix<double, 3, kSize>;
  /// Of a motion from now on.
  MotionFactor factor() const { return {geometry_, parameters(), noise(kSlipTail)}; }
  /// Of x and y; theta stays.
  static Eigen::Matrix3d rotation_of(double theta_rad);
  Measurement jacobian_at(const Epoch& epoch) const;
  Eigen::Vector3d velocity_in_map(const Epoch& epoch) const;
  void predict_gap(double duration_s);
  void compare_rotations(double difference_rad, double variance, double jitter_rad2,
                         Vector with_difference);
  /// Kalman update: the innovation's covariance, and the state's with it.
  template <int N>
  void update(const Eigen::Matrix<double, N, 1>& innovation,
              const Eigen::Matrix<double, kSize, N>& gain,
              const Eigen::Matrix<double, kSize, N>& with_innovation) {
    state_ += gain * innovation;
    covariance_ -= gain * with_innovation.transpose();
  }
  void detect_changes(const Measurement& with_innovation, const Cholesky3& root,
                      const Eigen::Vector3d& innovation);
  /// Variance of the rotation by slips; with a gyro there is none.
  double slip_rad2(double rolled_m) const {
    return has_gyro_ ? 0 : kSlipTail * slip_rate_.rad2_per_m() * rolled_m;
  }
  /// Of the sensor that measures the rotation.
  WalkNoiseEstimator& heading_noise() { return has_gyro_ ? gyro_noise_ : wheel_noise_; }
  const WalkNoiseEstimator& heading_noise() const { return has_gyro_ ? gyro_noise_ : wheel_noise_; }
  void switch_heading_sensor();
  /// The wheels' angle in the last advance() beside the gyro's, and in those before that had no
  /// count; `variance` of the difference without jitter.
  WalkStep wheels_beside_gyro(double variance, double jitter_rad2) const;
  /// A fix of this variance beside the heading by the sensor, without innovation and correction.
  WalkStep fix_beside_sensor(double fix_rad2, bool is_deskewed) const;
  /// Resets the sums since the last fix.
  void begin_walk();
  void keep_in_bounds();

  DriveGeometry geometry_;
  OdometryNoise noise_;
  Vector prior_sigma_ = Vector::Zero();
  double most_sigmas_;  ///< of the scales
  Vector state_ = Vector::Zero();
  Matrix covariance_ = Matrix::Zero();
  MotionFactor factor_;
  std::uint64_t slips_ = 0;
  RotationComparison rotations_;

  // Factors of variances as configured, shares of the floors of counts and fixes, and the variance
  // of the heading by each sensor since the last fix.
  WalkNoiseEstimator wheel_noise_;
  WalkNoiseEstimator gyro_noise_;
  NoiseEstimator fix_place_;
  double jitter_s2_ = 0;
  SlipRate slip_rate_;
  SlipRate seen_slip_rate_;  ///< with those since the last fix, by a gyro that may be wrong
  /// Of innovations along each parameter.
  Vector cusums_ = Vector::Zero();
  Vector cusum_variances_ = Vector::Zero();
  double wheel_rad2_ = 0;
  double gyro_rad2_ = 0;
  double by_wheels_rad_ = 0;  ///< change of the heading by compare_rotations() since the last fix
  double fixed_rad2_ = 0;     ///< variance of the heading after the last fix, changed alike
  WalkStep uncounted_;        ///< the wheels beside the gyro since the last count
  double rolled_m_ = 0;       ///< without a gyro, which would show slips
  int scans_ = 0;
  bool has_gyro_ = false;
};

}  // namespace cornerd::core
