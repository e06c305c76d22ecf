// SPDX-License-Identifier: MIT
#include "core/odometry/odometry_frame.hpp"

#include "core/odometry/motion_factor.hpp"

namespace cornerd::core {

void OdometryFrame::configure(const OdometryConfig& config) {
  const bool is_other_robot = !config.is_of_same_robot(config_);
  config_ = config;
  if (is_other_robot) gate_ = ReadingGate(config);
}

const OdometryPose* OdometryFrame::add(const OdometryReading& reading,
                                       const OdometryParameters& parameters) {
  if (!config_.enabled) return nullptr;
  const std::optional<OdometryIncrement> step = gate_.add(reading);
  if (!step) return nullptr;
  pose_.t_ns = step->to_ns;
  pose_.vx_m_s = pose_.omega_rad_s = 0;
  if (step->is_gap || step->to_ns <= step->from_ns) return &pose_;
  const CalibratedIncrement calibrated(*step, config_.geometry, parameters);
  pose_.T_odom_base = pose_.T_odom_base * calibrated.motion();
  pose_.vx_m_s = calibrated.travel_m / step->duration_s();
  pose_.omega_rad_s = calibrated.rotation_rad / step->duration_s();
  return &pose_;
}

}  // namespace cornerd::core
