// SPDX-License-Identifier: MIT
// How the robot moved during a scan.
#include <algorithm>
#include <array>
#include <cmath>

#include "core/geometry/ray_iterator.hpp"
#include "core/geometry/small_angle.hpp"
#include "core/geometry/squared.hpp"
#include "core/odometry/odometer.hpp"

namespace cornerd::core {
namespace {

/// A scan whose pieces are turned against each other seems to be elsewhere as well: by so much of
/// that angle, in rooms (NEES of fixes without a gyro, `cornerd-bench --odometry --robots`).
constexpr double kLever_m = 0.2;
/// A change of speed displaces what is between two readings by a share of what it comes to: a
/// constant acceleration by a twelfth in the mean, a sudden one by up to a quarter. Between the two
/// by NEES of fixes (`cornerd-bench --odometry`).
constexpr double kUnevenShare = 0.1;
/// The end of a scan that no reading tells of: of a change of speed in it, so much is in the pose.
/// The last reading is often a little older than the scan's end: that is nothing.
constexpr double kUnreadShare = 0.3;
constexpr TimeNs kSoon_ns = 50'000'000;

}  // namespace

bool Odometer::deskew(const Scan& scan, const Pose2& T_base_lidar, Scan& deskewed) const {
  if (!knows_motion_) return false;
  // The motion within one of these, 9 ms, is straight enough.
  constexpr std::size_t kPieces = 16;
  struct Piece {
    Vec2 from;
    Vec2 along;
    double from_rad;
    double along_rad;
  };
  std::array<Piece, kPieces> pieces;
  const Pose2 T_middle_start = (path_.at(middle_ns_ + delay_ns_) * T_base_lidar).inverse();
  const double piece_ns = std::max(1.0, static_cast<double>(end_ns_ - start_ns_) / kPieces);
  const auto T_middle_at = [&](std::size_t piece) {
    const TimeNs t_ns = start_ns_ + static_cast<TimeNs>(static_cast<double>(piece) * piece_ns);
    return T_middle_start * path_.at(t_ns + delay_ns_) * T_base_lidar;
  };
  Pose2 from = T_middle_at(0);
  for (std::size_t i = 0; i < kPieces; ++i) {
    const Pose2 to = T_middle_at(i + 1);
    pieces[i] = {from.translation(), to.translation() - from.translation(), from.theta_rad,
                 angle_between(from.theta_rad, to.theta_rad)};
    from = to;
  }
  deskewed.clear();
  RayIterator rays;
  const double pieces_per_ns = 1 / piece_ns;
  for (const Sample& sample : scan.samples()) {
    Sample moved = sample;
    if (sample.range_m > 0) {
      const double at = static_cast<double>(sample.t_ns - start_ns_) * pieces_per_ns;
      const auto i = static_cast<std::size_t>(std::clamp(at, 0.0, kPieces - 1.0));
      const Piece& piece = pieces[i];
      const double share = at - static_cast<double>(i);
      const double bearing_rad = sample.bearing_rad + piece.from_rad + share * piece.along_rad;
      const Vec2 shift = piece.from + share * piece.along;
      const Vec2& direction = rays.at(bearing_rad);
      const double along_m = sample.range_m + direction.dot(shift);
      const double across_m = cross(direction, shift);
      moved.bearing_rad =
          static_cast<float>(normalize_angle(bearing_rad + bearing_off(along_m, across_m)));
      moved.range_m = static_cast<float>(std::sqrt(squared(along_m) + squared(across_m)));
    }
    deskewed.add(moved);
  }
  return true;
}

Covariance3 Odometer::covariance_of_motion(double slip_share) const {
  const TimeNs from_ns = start_ns_ + delay_ns_;
  const TimeNs to_ns = end_ns_ + delay_ns_;
  const Pose2 motion = path_.at(from_ns).inverse() * path_.at(to_ns);
  const OdometryParameters sigma = filter_.sigma();
  const double place_m =
      std::hypot(sigma.left_scale, sigma.right_scale) / 2 * motion.translation().norm();
  const double rotation_rad =
      (filter_.has_gyro() ? sigma.gyro_scale : sigma.track_scale) / 2 * motion.theta_rad;
  // As one increment of the same motion.
  const DriveGeometry& geometry = config_.geometry;
  const double along_m = motion.translation().norm();
  const double aside_m = motion.theta_rad * geometry.track_m / 2;
  const double duration_s = to_seconds(end_ns_ - start_ns_);
  const CalibratedIncrement whole({.from_ns = start_ns_,
                                   .to_ns = end_ns_,
                                   .left_m = along_m - aside_m,
                                   .right_m = along_m + aside_m,
                                   .gyro_rad = motion.theta_rad,
                                   .has_gyro = filter_.has_gyro()},
                                  geometry, filter_.parameters());
  const Eigen::Matrix3d noise = whole.covariance(filter_.noise(slip_share));
  const double late_share2 = filter_.jitter_s2() / squared(std::max(duration_s, 1e-3));
  const double heading_noise = noise(2, 2);
  const double place_noise = (noise(0, 0) + squared(along_m / 2) * heading_noise) / 2;
  // When between two readings the robot changed its speed is unknown.
  const MotionPath::Change change = path_.mean_square_change(from_ns, to_ns);
  // The end of the scan that no reading tells of is extrapolated.
  const TimeNs unread_ns = config_.conservative ? to_ns - path_.newest_ns() - kSoon_ns : 0;
  const double unread_s = to_seconds(std::max<TimeNs>(0, unread_ns));
  const double unread_by_s =
      kUnreadShare * unread_s * unread_s / to_seconds(std::max<TimeNs>(1, end_ns_ - start_ns_));
  // Where in its count each wheel is: the scan's middle is off along its way by both wheels' mean
  // (less by the readings around it), its pieces are turned by the wheels' difference at two times.
  const double count_m2 = geometry.quantization_variance();
  const double counted_m2 = count_m2 / (filter_.has_gyro() ? 4 : 2);
  const double counted_rad2 = filter_.has_gyro() ? 0 : 4 * count_m2 / squared(geometry.track_m);
  const double lever_m2 = config_.conservative ? kLever_m * kLever_m : 0;
  const double place_m2 =
      place_m * place_m + squared(kUnevenShare) * change.x_m2 + counted_m2 +
      late_share2 * squared(along_m) +
      MotionFilter::kDeskewNoiseShare * (place_noise + lever_m2 * heading_noise);
  const double heading_rad2 =
      rotation_rad * rotation_rad + squared(kUnevenShare) * change.theta_rad2 + counted_rad2 +
      late_share2 * squared(motion.theta_rad) + MotionFilter::kDeskewNoiseShare * heading_noise;
  const double unread_m2 = squared(MotionFilter::kUnknown_m_s * unread_by_s);
  const double unread_rad2 = squared(MotionFilter::kUnknown_rad_s * unread_by_s);
  return Eigen::Vector3d(place_m2 + unread_m2, place_m2 + unread_m2, heading_rad2 + unread_rad2)
      .asDiagonal();
}

}  // namespace cornerd::core
