// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include <Eigen/Core>

#include "core/geometry/pose2.hpp"
#include "core/odometry/odometry_config.hpp"
#include "core/odometry/odometry_increment.hpp"

namespace cornerd::core {

/// Variances that grow with motion or time.
struct MotionNoise {
  double wheel_m2_per_m = 0;      ///< of a wheel's travel
  double scrub_rad2_per_rad = 0;  ///< of the wheels' rotation: tyres touch the floor somewhere
  double slip_rad2_per_m = 0;     ///< of the same, by slips: one wheel's travel is wrong
  double gyro_rad2_per_s = 0;     ///< of the gyro's rotation
};

/// One increment by the parameters, with travels L, R and gyro integral G over dt:
///
///     s = ((1 + l) L + (1 + r) R) / 2,  f = ((1 + r) R - (1 + l) L) / (track (1 + t))
///     w = (G - b dt) / (1 + g) with a gyro, else f
struct CalibratedIncrement {
  CalibratedIncrement(const OdometryIncrement& step, const DriveGeometry& geometry,
                      const OdometryParameters& by);

  double duration_s = 0;
  double track_m = 0;
  double gyro_gain = 1;  ///< 1 + g
  double left_m = 0;
  double right_m = 0;
  double travel_m = 0;            ///< s
  double wheel_rotation_rad = 0;  ///< f
  double rotation_rad = 0;        ///< w
  double gyro_change_rad = 0;     ///< as in OdometryIncrement
  bool has_gyro = false;

  Pose2 motion() const { return arc(travel_m, rotation_rad); }
  /// By both wheels, the mean of both.
  double rolled_m() const;
  /// Covariance of s, f and w.
  Eigen::Matrix3d covariance(const MotionNoise& noise) const;
};

/// Wheel counts and gyro rates between two times, preintegrated on SE(2) (Forster et al. 2017, with
/// a differential drive's travel): the motion in the frame of `base` at the first time, for
/// parameters c, with its covariance and its slopes. Per increment, midpoint rule:
///
///     p += s (cos(theta + w / 2), sin(theta + w / 2)),  theta += w,  phi += f
///
/// phi - theta is zero but for noise: the wheels are a second measurement of the rotation. Counts
/// telescope, so quantization enters at both ends only: by jacobian() for the wheels' positions
/// within their counts at the first time, by end_slope() for those at the last. Metres, radians.
class MotionFactor {
 public:
  /// Rows: x, y, theta, phi.
  static constexpr int kRows = 4;
  enum Parameter : std::uint8_t { kBias, kLeft, kRight, kTrack, kGyro, kLeftRest, kRightRest };
  static constexpr int kParameters = 7;
  using Column = Eigen::Matrix<double, kRows, 1>;
  using Covariance = Eigen::Matrix<double, kRows, kRows>;
  using Jacobian = Eigen::Matrix<double, kRows, kParameters>;
  using EndSlope = Eigen::Matrix<double, kRows, 2>;

  /// `at`: the parameters of the linearization.
  MotionFactor(const DriveGeometry& geometry, const OdometryParameters& at,
               const MotionNoise& noise = {})
      : geometry_(geometry),
        track_m_(geometry.track_m * (1 + at.track_scale)),
        at_(at),
        noise_(noise) {}

  /// Goes on by an increment that is no gap and begins where the last one ended.
  void add(const OdometryIncrement& step);

  Pose2 motion() const { return {p_[0], p_[1], normalize_angle(p_[2])}; }
  /// The gyro's, or the wheels' where there is no gyro; not wrapped.
  double rotation_rad() const { return p_[2]; }
  double wheel_rotation_rad() const { return p_[3]; }

  double duration_s() const { return duration_s_; }
  /// By both wheels, the mean of both.
  double rolled_m() const { return rolled_m_; }
  /// Every increment has the gyro's rotation.
  bool has_gyro() const { return has_gyro_ && duration_s_ > 0; }
  /// A count came.
  bool is_counted() const { return is_counted_; }

  /// Of the noise of wheels and gyro alone.
  const Covariance& covariance() const { return covariance_; }
  const Jacobian& jacobian() const { return jacobian_; }
  /// By the metres that each wheel has rolled beyond the middle of its count at the last time.
  EndSlope end_slope() const;
  /// By the time offset, a second of it: exp(-v_0) motion exp(v_1), by the velocities at both ends.
  Column delay_slope() const;

 private:
  struct Velocity {
    double speed_m_s = 0;
    double rate_rad_s = 0;
    double wheel_rate_rad_s = 0;
  };

  DriveGeometry geometry_;
  double track_m_;
  OdometryParameters at_;
  MotionNoise noise_;
  Column p_ = Column::Zero();
  Covariance covariance_ = Covariance::Zero();
  Jacobian jacobian_ = Jacobian::Zero();
  Velocity first_;
  Velocity last_;
  double duration_s_ = 0;
  double rolled_m_ = 0;
  bool has_gyro_ = true;
  bool is_counted_ = false;
  bool ends_by_gyro_ = false;
};

}  // namespace cornerd::core
