// SPDX-License-Identifier: MIT
// A driving robot with an odometer.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "core/odometry/odometer.hpp"
#include "driven_robot.hpp"

namespace cornerd::core::testing {

inline const Covariance3 kFixCovariance = Covariance3::Identity() * 1e-6;

/// Readings at 50 Hz, a scan every 7 of them; each reading arrives `late` readings late.
class OdometerDrive {
 public:
  explicit OdometerDrive(const OdometryConfig& config, int late = 0, int every = 1)
      : odometer(config), robot_(config.geometry, errors(), 3), late_(late), every_(every) {}

  static RobotErrors errors() {
    RobotErrors errors;
    errors.left_scale = 0.01;
    errors.gyro_bias_rad_s = 0.01;
    errors.wheel_m_per_sqrt_m = 0.001;
    errors.gyro_rad_s_per_sqrt_hz = 0.0003;
    return errors;
  }

  /// Drives to the end of the next scan; `truth` is then the pose at its middle.
  void drive_scan(bool readings = true) {
    const TimeNs start_ns = robot_.now_ns();
    for (int i = 0; i < 14; ++i, ++ticks_) {
      const Rates rates = lively_drive(0.01 * ticks_);
      OdometryReading reading = robot_.drive(0.01, rates.speed_m_s, rates.rate_rad_s);
      if (i == 6) truth = robot_.truth();
      if (spoil) spoil(spoiled_++, reading);
      waiting_.push_back(reading);
      if (waiting_.size() <= static_cast<std::size_t>(late_)) continue;
      if (readings && ticks_ % every_ == 0) odometer.add(waiting_.front().arrived(robot_.now_ns()));
      waiting_.erase(waiting_.begin());
    }
    odometer.advance(start_ns, start_ns + 70'000'000, robot_.now_ns());
  }
  double error_m() const {
    const auto predicted = odometer.prediction();
    if (!predicted) return 1e9;
    return (predicted->T_map_base.translation() - truth.translation()).norm();
  }

  /// One more reading, and the robot's pose then.
  Pose2 go_on() {
    const Rates rates = lively_drive(0.01 * ticks_++);
    const OdometryReading reading = robot_.drive(0.01, rates.speed_m_s, rates.rate_rad_s);
    odometer.add(reading.arrived(reading.t_ns));
    return robot_.truth();
  }

  Odometer odometer;
  Pose2 truth;
  std::function<void(int, OdometryReading&)> spoil;

 private:
  DrivenRobot robot_;
  int late_;
  int every_;
  int ticks_ = 0;
  int spoiled_ = 0;
  std::vector<OdometryReading> waiting_;
};

}  // namespace cornerd::core::testing
