// SPDX-License-Identifier: MIT
// Interface of odometry to the localizer: predicted poses, and deskewing of scans.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "core/geometry/pose2.hpp"
#include "core/odometry/delay_finder.hpp"
#include "core/odometry/fix_watch.hpp"
#include "core/odometry/fusion_filter.hpp"
#include "core/odometry/gyro_proof.hpp"
#include "core/odometry/motion_path.hpp"
#include "core/odometry/noise_meter.hpp"
#include "core/odometry/odometry_config.hpp"
#include "core/odometry/odometry_reading.hpp"
#include "core/odometry/odometry_summary.hpp"
#include "core/odometry/reading_gate.hpp"
#include "core/odometry/turn_slips.hpp"
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

  /// `now_ns`: see ReadingGate. True where the reading gave an increment: predict_latest() then
  /// holds for its time.
  bool add(const OdometryReading& reading, std::optional<TimeNs> now_ns);

  /// Advances to the middle of a scan that ends at `end_ns`. The calls that follow hold for that
  /// time.
  void advance(TimeNs start_ns, TimeNs middle_ns, TimeNs end_ns);

  /// Deskews the scan to the lidar's pose at its middle. False where the motion is unknown; `still`
  /// is then unchanged.
  bool deskew(const Scan& turn, const Pose2& T_base_lidar, Scan& still) const;
  /// True where deskew() succeeds.
  bool has_motion() const { return knows_motion_; }
  /// The scan shows another motion than the readings: discard it.
  void reject_motion();
  /// Covariance from the motion left in a deskewed scan.
  Covariance3 deskew_covariance() const;

  /// Predicted pose; nullopt before the first fix, max_extrapolation_s after the last one, and
  /// while wheels and lidar are inconsistent.
  std::optional<PredictedPose> prediction() const;

  /// True where the readings may miss a motion: their delay is not yet observable, or they pause.
  bool may_miss_motion() const;

  /// The same at the time of the newest reading, for OdometryConfig::publish_predictions.
  std::optional<PredictedPose> predict_latest();

  /// Updates the filter by a fix of the lidar at the time reached.
  void correct(const Pose2& T_map_base, const Covariance3& covariance);
  /// Sets the pose at the time reached; does not update the parameters.
  void set_pose(const Pose2& T_map_base, const Covariance3& covariance);
  /// Forgets the pose; the parameters stay.
  void forget();

  OdometrySummary summary() const;

 private:
  /// By as much a robot may have changed its speed in a time of which no reading tells.
  static constexpr double kChange_m_s = 0.5;
  static constexpr double kChange_rad_s = 1.5;

  /// More readings than come in half a turn of the slowest lidar, at 500 a second.
  static constexpr std::size_t kPending = 256;

  void begin_anew(const OdometryIncrement& hole);
  /// All that was learned with another delay was learned wrong.
  void learn_anew(double delay_s);
  bool learns_delay() const;
  double delay_doubt_s2(double delay_s) const;
  void consume(const OdometryIncrement& step);
  void add_stranger(const Pose2& T_map_base, const Covariance3& covariance);
  /// The covariance of a fix with what it does not know of, as much as fixes lately showed and as
  /// this one needs.
  Covariance3 learned_doubt(const Pose2& T_map_base, const Covariance3& covariance);
  std::optional<PredictedPose> prediction_of(const FusionFilter& filter, TimeNs t_ns,
                                             TimeNs guessed_ns) const;
  /// Of what was driven since the last fix: slips that no gyro shows.
  Covariance3 doubt_of_slips(const FusionFilter& filter) const;
  bool doubts_slips() const { return config_.conservative && !last_.has_gyro; }
  void watch_for_slips(const Pose2& T_map_base, const Covariance3& covariance);
  /// What a robot makes of a time, its variance in s^2, of which no reading tells.
  static Covariance3 doubt_of_change(double unread_s2);
  static Covariance3 doubt_of_guess(TimeNs guessed_ns);
  /// What the filter has moved on beyond the newest reading.
  TimeNs guessed_ns() const { return config_.conservative ? guessed_.to_ns - guessed_.from_ns : 0; }
  /// False where wheels, gyro and lidar have lately told different stories.
  bool is_believed() const;
  void tell_velocity(FusionFilter& filter, TimeNs t_ns) const;
  void consume_until(TimeNs t_ns);
  void guess_until(TimeNs t_ns);

  OdometryConfig config_;
  ReadingGate gate_;
  FusionFilter filter_;
  MotionPath path_;
  DelayFinder delays_;

  std::array<OdometryIncrement, kPending> pending_;  ///< not yet in the filter; a ring
  std::size_t first_ = 0;
  std::size_t size_ = 0;
  TimeNs reached_ns_ = 0;      ///< the filter stands here, by the readings' times
  OdometryIncrement last_;     ///< the newest whole step in the filter, for a guess
  OdometryIncrement guessed_;  ///< what the filter has taken beyond the newest reading

  FusionFilter ahead_;               ///< with what is pending
  std::size_t ahead_by_ = 0;         ///< steps of what is pending; where it is stale, none
  OdometryIncrement ahead_guessed_;  ///< as guessed_
  bool ahead_is_stale_ = true;       ///< the filter has moved since

  TimeNs start_ns_ = 0;  ///< of the turn
  TimeNs middle_ns_ = 0;
  TimeNs end_ns_ = 0;
  TimeNs delay_ns_ = 0;  ///< of the readings, as it was learned before the turn
  bool knows_motion_ = false;
  bool has_pose_ = false;
  bool present_ = false;
  TimeNs fixed_ns_ = 0;
  double fixed_heading_rad_ = 0;
  FixWatch fix_watch_;
  GyroProof gyro_proof_;
  TurnSlips turn_slips_;
  /// Of the floors' variances. A twentieth stays: half a millimetre is the same from turn to turn.
  NoiseMeter place_floor_{10, 0.06, 1};
  NoiseMeter heading_floor_{5, 0.03, 1};
  std::uint64_t fixes_ = 0;
  std::uint64_t strangers_ = 0;
};

}  // namespace cornerd::core
