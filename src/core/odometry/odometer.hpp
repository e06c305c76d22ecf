// SPDX-License-Identifier: MIT
// Interface of odometry to the localizer: predicted poses, and deskewing of scans.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "core/geometry/pose2.hpp"
#include "core/odometry/count_interpolator.hpp"
#include "core/odometry/motion_filter.hpp"
#include "core/odometry/motion_path.hpp"
#include "core/odometry/motion_trust.hpp"
#include "core/odometry/odometry_config.hpp"
#include "core/odometry/odometry_frame.hpp"
#include "core/odometry/odometry_reading.hpp"
#include "core/odometry/odometry_summary.hpp"
#include "core/odometry/reading_gate.hpp"
#include "core/scan.hpp"

namespace cornerd::core {

struct PredictedPose {
  TimeNs t_ns = 0;
  Pose2 T_map_base;
  Covariance3 covariance = Covariance3::Zero();
};

/// Takes readings at any rate and of any quality and predicts poses. The filter stands at the time
/// of the newest scan; later readings wait. Allocates nothing after construction. Not safe for
/// concurrent calls.
class Odometer {
 public:
  explicit Odometer(const OdometryConfig& config);

  bool enabled() const { return config_.enabled; }

  /// True where the reading gave an increment: predict_latest() then holds for its time.
  bool add(const OdometryReading& reading);
  /// Measured by the last reading, if it was; for the frame `odom`.
  const std::optional<MeasuredMotion>& last_motion() const { return last_motion_; }

  /// Advances to the middle of a scan that ends at `end_ns`. The calls that follow hold for that
  /// time.
  void advance(TimeNs start_ns, TimeNs middle_ns, TimeNs end_ns);

  /// Deskews the scan to the lidar's pose at its middle. False where the motion is unknown;
  /// `deskewed` is then unchanged.
  bool deskew(const Scan& scan, const Pose2& T_base_lidar, Scan& deskewed) const;
  /// True where deskew() succeeds.
  bool has_motion() const { return knows_motion_; }
  /// The scan shows another motion than the readings: discard it.
  void reject_motion() { knows_motion_ = false; }
  /// Covariance from the motion left in a deskewed scan, whose walls no slip bends.
  const Covariance3& deskew_covariance() const { return deskew_covariance_; }
  /// The same where a wheel may have slipped in the scan; a gyro would show it.
  Covariance3 deskew_covariance_with_slips() const {
    return filter_.has_gyro() ? deskew_covariance_ : covariance_of_motion(/*slip_share=*/1);
  }

  /// Predicted pose; nullopt before the first fix, max_extrapolation_s after the last one, and
  /// while sensors that it is made of are not known to be right.
  std::optional<PredictedPose> prediction() const;
  /// The same however long ago the last fix was: what a fix elsewhere is weighed against.
  std::optional<PredictedPose> dead_reckoning() const;

  /// True where the readings may miss a motion: their delay is not yet observable, or they pause.
  bool may_miss_motion() const;

  /// The same at the time of the newest reading, for OdometryConfig::publish_predictions.
  std::optional<PredictedPose> predict_latest() const;

  /// Updates the filter by a fix of the lidar at the time reached.
  void correct(const Pose2& T_map_base, const Covariance3& covariance);
  /// Sets the pose at the time reached; neither it nor the next fix updates the parameters.
  void set_pose(const Pose2& T_map_base, const Covariance3& covariance);
  /// Forgets the pose; the parameters stay.
  void forget();
  /// Forgets all but the last reading and where in their counts the wheels are, so that the next
  /// one still tells of a motion.
  void reset();
  /// Takes over the readings of another odometer, its parameters and what it knows of the sensors,
  /// not its pose. Nothing where its config is of another robot.
  void resume(const Odometer& other);

  OdometrySummary summary() const;

 private:
  /// More readings than come in half a scan of the slowest lidar, at 500 a second.
  static constexpr std::size_t kPending = 256;
  static constexpr int kContradiction = 3;

  const OdometryIncrement& pending(std::size_t i) const {
    return pending_[(first_ + i) % kPending];
  }
  void restart(const OdometryIncrement& gap);
  /// Without the gyro's rotation where wheels are trusted more.
  OdometryIncrement trusted(OdometryIncrement step) const;
  /// The same with the travel of wheels that go on within their counts.
  OdometryIncrement interpolated(OdometryIncrement step);
  Covariance3 covariance_of_motion(double slip_share) const;
  void consume_front(std::optional<TimeNs> until_ns = std::nullopt);
  MotionFilter::Epoch epoch_at(TimeNs reading_ns, TimeNs reached_ns) const;
  std::optional<PredictedPose> prediction_of(const MotionFilter& filter,
                                             const MotionFilter::Epoch& epoch, TimeNs t_ns) const;
  /// Not older than max_extrapolation_s.
  std::optional<PredictedPose> in_time(const std::optional<PredictedPose>& pose) const;
  /// A survey's fixes are no better than its odometry: there a few in a row tell.
  bool is_believed() const {
    return filter_.is_in_bounds() &&
           (config_.conservative ? trust_.is_healthy() : rejected_in_a_row_ < kContradiction);
  }

  OdometryConfig config_;
  ReadingGate gate_;
  MotionFilter filter_;
  MotionTrust trust_;
  MotionPath path_;
  CountInterpolator left_;
  CountInterpolator right_;
  std::optional<MeasuredMotion> last_motion_;

  std::array<OdometryIncrement, kPending> pending_;  ///< not yet in the filter; a ring
  std::size_t first_ = 0;
  std::size_t size_ = 0;
  TimeNs reached_ns_ = 0;  ///< the filter stands here, by the readings' times

  TimeNs start_ns_ = 0;  ///< of the scan
  TimeNs middle_ns_ = 0;
  TimeNs end_ns_ = 0;
  TimeNs delay_ns_ = 0;        ///< of the readings, as estimated before the scan
  MotionFilter::Epoch epoch_;  ///< of the scan's middle
  Covariance3 deskew_covariance_ = Covariance3::Zero();
  bool knows_motion_ = false;
  bool has_pose_ = false;
  bool pose_is_given_ = false;  ///< by set_pose(): no evidence about the sensors
  bool present_ = false;
  int rejected_in_a_row_ = 0;  ///< fixes: which of both is wrong, the next one shows
  TimeNs fixed_ns_ = 0;
  std::uint64_t fixes_ = 0;
  std::uint64_t rejected_fixes_ = 0;
};

}  // namespace cornerd::core
