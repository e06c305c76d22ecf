// SPDX-License-Identifier: MIT
#include "core/odometry/odometry_frame.hpp"

#include <cmath>

#include "core/odometry/motion_factor.hpp"

namespace cornerd::core {

void OdometryFrame::configure(const OdometryConfig& config) {
  is_enabled_ = config.enabled;
  geometry_ = config.geometry;
  gate_ = ReadingGate(config);
}

const OdometryPose* OdometryFrame::add(const OdometryReading& reading, std::optional<TimeNs> now_ns,
                                       const OdometryParameters& parameters) {
  if (!is_enabled_) return nullptr;
  const std::optional<OdometryIncrement> step = gate_.add(reading, now_ns);
  if (!step) return nullptr;
  pose_.t_ns = step->to_ns;
  pose_.vx_m_s = pose_.omega_rad_s = 0;
  if (step->is_gap || step->to_ns <= step->from_ns) return &pose_;
  MotionFactor factor(geometry_, parameters);
  factor.add(*step);
  const Pose2 motion = factor.motion();
  pose_.T_odom_base = pose_.T_odom_base * motion;
  pose_.vx_m_s = std::copysign(motion.translation().norm(), motion.x_m) / step->duration_s();
  pose_.omega_rad_s = factor.rotation_rad() / step->duration_s();
  return &pose_;
}

}  // namespace cornerd::core
