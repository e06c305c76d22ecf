// SPDX-License-Identifier: MIT
#include "tool/simulate/odometry_options.hpp"

#include <vector>

#include "tool/command_line/command.hpp"
#include "tool/command_line/failure.hpp"
#include "tool/command_line/shared_options.hpp"

namespace cornerd::tool {

namespace {

core::Vec2 parse_pair(const std::string& text, const char* option) {
  const std::vector<core::Vec2> pairs = parse_points(text);
  if (pairs.size() != 1) throw UsageError(std::string(option) + " takes one pair: A,B");
  return pairs.front();
}

}  // namespace

void OdometryOptions::add_to(Command& command) {
  command.add_flag(
      "--odometry", enabled,
      "ODOMETRY lines with the geometry of the config (odometry.wheel_radius ...), in the "
      "recording, or to the control socket of the config");
  command.add_option("--odometry-rate", model.rate_hz, "rate of the readings (Hz)")
      .within(1, 1000)
      .capture_default_str();
  command.add_option("--wheel-errors", wheel_errors, "scale errors of the wheel radii: 0.015,0.025")
      .type_name("LEFT,RIGHT");
  command.add_option("--track-error", model.track_scale, "scale error of the track")
      .within(-0.5, 0.5);
  command
      .add_option("--wheel-noise", model.wheel_m_per_sqrt_m,
                  "standard deviation of a wheel's distance after one metre (m)")
      .within(0, 1)
      .capture_default_str();
  command.add_option("--gyro-error", model.gyro_scale, "scale error of the gyro").within(-0.5, 0.5);
  command.add_option("--gyro-bias", model.gyro_bias_rad_s, "bias of the gyro (rad/s)")
      .within(-1, 1);
  command
      .add_option("--gyro-noise", model.gyro_rad_s_per_sqrt_hz,
                  "noise of the gyro (rad/s/sqrt(Hz))")
      .within(0, 1)
      .capture_default_str();
  command.add_flag("--no-gyro", no_gyro, "readings of the encoders only");
  command
      .add_option("--slips", model.slips_per_m,
                  "slips of a wheel per metre: 50 % more rotation for 0.2 s")
      .within(0, 100);
}

std::optional<replay::RobotModel> OdometryOptions::robot(
    const settings::OdometryConfig& config) const {
  if (!enabled) return std::nullopt;
  replay::RobotModel robot = model;
  robot.geometry = config.core.geometry;
  robot.has_gyro = !no_gyro;
  if (!wheel_errors.empty()) {
    const core::Vec2 scales = parse_pair(wheel_errors, "--wheel-errors");
    if (!(scales.cwiseAbs().maxCoeff() <= 0.5)) {
      throw UsageError("--wheel-errors: no more than 0.5 each");
    }
    robot.left_scale = scales.x();
    robot.right_scale = scales.y();
  }
  return robot;
}

OdometryOptions::Times OdometryOptions::covered_times() const {
  if (covered.empty()) return {};
  const core::Vec2 times_s = parse_pair(covered, "--covered");
  if (!(times_s.x() >= 0 && times_s.x() < times_s.y() && times_s.y() < 1e6)) {
    throw UsageError("--covered: must be two ascending times (s)");
  }
  return {core::from_seconds(times_s.x()), core::from_seconds(times_s.y())};
}

}  // namespace cornerd::tool
