// SPDX-License-Identifier: MIT
// What a localizer asks of odometry: where the robot is by now, and how it moved during a turn.
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

/// Readings in, at any rate and of any quality; predictions out. The filter follows the lidar: it
/// stands at the time of the newest turn, and what came after waits. Allocates nothing after
/// construction. Not safe for concurrent calls.
class Odometer {
 public:
  explicit Odometer(const OdometryConfig& config);

  bool enabled() const { return config_.enabled; }

  /// `now_ns`: see ReadingGate. True where it moved the robot on: ahead() is of its time then.
  bool add(const OdometryReading& reading, std::optional<TimeNs> now_ns);

  /// Goes on to the middle of a turn that ends at `end_ns`. All that follows is about that time.
  void advance(TimeNs start_ns, TimeNs middle_ns, TimeNs end_ns);

  /// The samples of the turn as a lidar that stood still in its middle would have seen them; false
  /// where the motion is not known, and `still` is not touched.
  bool straighten(const Scan& turn, const Pose2& T_base_lidar, Scan& still) const;
  /// True where straighten() can.
  bool knows_motion() const { return knows_motion_; }
  /// What it said of this turn is not to be used: the turn shows another motion.
  void disbelieve_motion();
  /// What is left of the motion within a straightened turn.
  Covariance3 doubt_of_motion() const;

  /// Where the robot should be; nullopt before the first fix, long after the last one, and where
  /// wheels and lidar have lately told different stories.
  std::optional<PredictedPose> prediction() const;

  /// That the robot sets out or turns, the readings may not know yet: how late they are no change
  /// of speed has shown, or they pause.
  bool may_miss_motion() const;

  /// The same at the time of the newest reading, for OdometryConfig::publish.
  std::optional<PredictedPose> ahead();

  /// The lidar's pose for the time reached; teaches.
  void correct(const Pose2& T_map_base, const Covariance3& covariance);
  /// From somebody else, for the time reached; teaches nothing.
  void set_pose(const Pose2& T_map_base, const Covariance3& covariance);
  /// Where the robot is is no longer known; what was learned stays.
  void forget();

  OdometrySummary summary() const;

 private:
  /// By as much a robot may have changed its speed in a time of which no reading tells.
  static constexpr double kChange_m_s = 0.5;
  static constexpr double kChange_rad_s = 1.5;

  /// More readings than come in half a turn of the slowest lidar, at 500 a second.
  static constexpr std::size_t kPending = 256;

  void begin_anew(const MotionStep& hole);
  /// All that was learned with another delay was learned wrong.
  void learn_anew(double delay_s);
  bool learns_delay() const;
  double delay_doubt_s2(double delay_s) const;
  void consume(const MotionStep& step);
  void add_stranger(const Pose2& T_map_base, const Covariance3& covariance);
  /// The covariance of a fix with what it does not know of, as much as fixes lately showed and as
  /// this one needs.
  Covariance3 learned_doubt(const Pose2& T_map_base, const Covariance3& covariance);
  std::optional<PredictedPose> prediction_of(const FusionFilter& filter, TimeNs t_ns,
                                             TimeNs guessed_ns) const;
  /// Of what was driven since the last fix: slips that no gyro shows.
  Covariance3 doubt_of_slips(const FusionFilter& filter) const;
  bool doubts_slips() const { return config_.wary && !last_.has_gyro; }
  void watch_for_slips(const Pose2& T_map_base, const Covariance3& covariance);
  /// What a robot makes of a time, its variance in s^2, of which no reading tells.
  static Covariance3 doubt_of_change(double unread_s2);
  static Covariance3 doubt_of_guess(TimeNs guessed_ns);
  /// What the filter has moved on beyond the newest reading.
  TimeNs guessed_ns() const { return config_.wary ? guessed_.to_ns - guessed_.from_ns : 0; }
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

  std::array<MotionStep, kPending> pending_;  ///< not yet in the filter; a ring
  std::size_t first_ = 0;
  std::size_t size_ = 0;
  TimeNs reached_ns_ = 0;  ///< the filter stands here, by the readings' times
  MotionStep last_;        ///< the newest whole step in the filter, for a guess
  MotionStep guessed_;     ///< what the filter has taken beyond the newest reading

  FusionFilter ahead_;          ///< with what is pending
  std::size_t ahead_by_ = 0;    ///< steps of what is pending; where it is stale, none
  MotionStep ahead_guessed_;    ///< as guessed_
  bool ahead_is_stale_ = true;  ///< the filter has moved since

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
