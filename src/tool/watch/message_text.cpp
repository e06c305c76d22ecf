// SPDX-License-Identifier: MIT
#include "tool/watch/message_text.hpp"

#include <cmath>
#include <string_view>
#include <variant>

#include "core/geometry/angle.hpp"
#include "message/line_writer.hpp"
#include "tool/drawing/text_table.hpp"

namespace cornerd::tool {

namespace {

std::string pose_of(const core::Pose2& T_map_base) {
  return formatted("x %.3f y %.3f m, %.1f degrees", T_map_base.x_m, T_map_base.y_m,
                   core::degrees(T_map_base.theta_rad));
}

std::string describe(const message::ParsedPose& pose) {
  std::string text = formatted("%.3f %-9s ", core::to_seconds(pose.t_ns),
                               std::string(message::to_string(pose.state)).c_str());
  if (pose.T_map_base) text += pose_of(*pose.T_map_base);
  if (pose.covariance) {
    const core::Covariance3& covariance = *pose.covariance;
    text += formatted(" (sigma %.1f mm, %.2f degrees)",
                      1e3 * std::sqrt(covariance(0, 0) + covariance(1, 1)),
                      core::degrees(std::sqrt(covariance(2, 2))));
  }
  if (!pose.map.empty()) text += " in " + pose.map;
  if (!pose.room.empty()) text += ", " + pose.room;
  if (pose.age_s) text += formatted(", %.1f s since the last scan that fits", *pose.age_s);
  for (const core::Alternative& alternative : pose.alternatives) {
    text += "\n    or " + pose_of(alternative.T_map_base);
  }
  return text + "\n";
}

std::string describe(const message::ParsedStatus& status) {
  std::string text = "lidar " + status.lidar_state;
  if (!status.lidar_model.empty()) text += ", " + status.lidar_model;
  if (!status.lidar_mode.empty()) text += ", " + status.lidar_mode;
  if (status.rate_hz) text += formatted(", %.1f scans/s", *status.rate_hz);
  if (!status.odometry_state.empty()) text += "; odometry " + status.odometry_state;
  if (status.latency_p99_s) text += formatted("; latency p99 %.1f ms", 1e3 * *status.latency_p99_s);
  if (!status.hint.empty()) text += "\n    " + status.hint;
  return text + "\n";
}

std::string describe(const message::ParsedOdom& odom) {
  return formatted("%.3f odom      ", core::to_seconds(odom.t_ns)) + pose_of(odom.T_odom_base) +
         formatted(", %.3f m/s, %.1f degrees/s\n", odom.vx_m_s, core::degrees(odom.omega_rad_s));
}

std::string describe(const message::ParsedEvent& event) {
  return event.what + (event.detail.empty() ? "" : ": " + event.detail) + "\n";
}

std::string describe(const message::ParsedVersion& version) {
  return version.program + " " + version.version + "\n";
}

std::string describe(const message::ParsedError& error) {
  return "error " + error.code + ": " + error.text + "\n";
}

template <typename Other>
std::string describe(const Other&) {
  return {};
}

}  // namespace

std::string message_text(const message::ParsedLine& line) {
  return std::visit([](const auto& parsed) { return describe(parsed); }, line);
}

}  // namespace cornerd::tool
