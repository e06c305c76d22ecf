// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "core/odometry/odometry_reading.hpp"
#include "replay/simulator/motion.hpp"
#include "replay/simulator/random.hpp"
#include "replay/simulator/robot_model.hpp"

namespace cornerd::replay {

/// What the encoders and the gyro of a robot on a drive say, reading by reading. Same model, same
/// drive, same seed: same readings.
class SimulatedOdometry {
 public:
  /// Throws std::invalid_argument where the rate is not in [1, 1000] Hz.
  SimulatedOdometry(Motion motion, const RobotModel& model, std::uint64_t seed);

  core::TimeNs next_ns() const { return next_ns_; }
  core::OdometryReading next();

 private:
  void roll(core::TimeNs to_ns);
  double rolled(double way_m, double radius_scale);

  Motion motion_;
  RobotModel model_;
  Random random_;
  core::TimeNs period_ns_;
  core::TimeNs next_ns_ = 0;
  core::TimeNs now_ns_ = 0;
  core::Pose2 T_map_base_;
  double left_m_ = 0;  ///< by the configured radius
  double right_m_ = 0;
  double rate_rad_s_ = 0;
  double until_slip_m_ = 0;
  core::TimeNs slips_until_ns_ = 0;
  bool left_slips_ = false;
};

}  // namespace cornerd::replay
