// SPDX-License-Identifier: MIT
#include "web/metrics.hpp"

#include <cstdio>
#include <optional>
#include <string_view>

#include "core/types.hpp"
#include "message/line_writer.hpp"
#include "message/parsed_line.hpp"

namespace cornerd::web {

namespace {

using message::MessageClass;

class MetricsWriter {
 public:
  void describe(const std::string& name, std::string_view type, std::string_view help) {
    text_ += "# HELP " + name + " " + std::string(help) + "\n# TYPE " + name + " " +
             std::string(type) + "\n";
  }
  void value(const std::string& name_and_labels, double value) {
    char number[40];
    std::snprintf(number, sizeof number, " %.17g\n", value);
    text_ += name_and_labels + number;
  }
  void gauge(const std::string& name, std::string_view help, std::optional<double> number) {
    if (!number) return;
    describe(name, "gauge", help);
    value(name, *number);
  }
  std::string take() { return std::move(text_); }

 private:
  std::string text_;
};

void write_pose(MetricsWriter& out, const message::ParsedPose& pose) {
  out.describe("cornerd_pose_state", "gauge", "1 for the state of the last pose.");
  for (const auto state :
       {core::PoseState::kFix, core::PoseState::kTracking, core::PoseState::kPredicted,
        core::PoseState::kAmbiguous, core::PoseState::kLost}) {
    out.value("cornerd_pose_state{state=\"" + std::string(message::to_string(state)) + "\"}",
              pose.state == state ? 1 : 0);
  }
  out.gauge("cornerd_pose_timestamp_seconds", "Time of the last pose.",
            core::to_seconds(pose.t_ns));
  out.gauge("cornerd_pose_age_seconds", "Time since the last fix or tracking.", pose.age_s);
  out.gauge("cornerd_pose_rmse_meters", "Of the inliers to the map.", pose.rmse_m);
  out.gauge("cornerd_pose_wrong_probability", "That the pose, or the first alternative, is wrong.",
            pose.p_wrong);
  if (!pose.T_map_base) return;
  out.gauge("cornerd_pose_x_meters", "Position in the map.", pose.T_map_base->x_m);
  out.gauge("cornerd_pose_y_meters", "Position in the map.", pose.T_map_base->y_m);
  out.gauge("cornerd_pose_theta_radians", "Heading in the map.", pose.T_map_base->theta_rad);
}

void write_status(MetricsWriter& out, const message::ParsedStatus& status) {
  out.gauge("cornerd_lidar_running", "1 while the lidar delivers samples.",
            status.lidar_state == "running" ? 1 : 0);
  out.gauge("cornerd_lidar_scans_hertz", "Scans per second.", status.rate_hz);
  out.gauge("cornerd_lidar_samples_hertz", "Samples per second.", status.samples_hz);
  if (status.latency_p50_s && status.latency_p99_s) {
    out.describe("cornerd_latency_seconds", "gauge",
                 "From a scan's last sample to its pose, last 200 scans.");
    out.value("cornerd_latency_seconds{percentile=\"50\"}", *status.latency_p50_s);
    out.value("cornerd_latency_seconds{percentile=\"99\"}", *status.latency_p99_s);
  }
  for (const auto& [name, count] : status.counters) {
    const std::string metric = "cornerd_" + name;
    // "clients" goes down too.
    if (name == "clients") {
      out.gauge(metric, "Connected clients of the daemon.", static_cast<double>(count));
      continue;
    }
    out.describe(metric + "_total", "counter", "STATUS counter " + name + ".");
    out.value(metric + "_total", static_cast<double>(count));
  }
}

}  // namespace

std::string metrics_text(const Hub& hub) {
  MetricsWriter out;
  out.gauge("cornerd_up", "1 while cornerd-web is connected to the daemon.",
            hub.is_connected() ? 1 : 0);
  out.gauge("cornerd_web_streams", "Clients of /api/events.", static_cast<double>(hub.listeners()));
  if (const Line line = hub.last(MessageClass::kPose)) {
    const auto parsed = message::parse_line(*line);
    if (const auto* pose = std::get_if<message::ParsedPose>(&parsed)) write_pose(out, *pose);
  }
  if (const Line line = hub.last(MessageClass::kStatus)) {
    const auto parsed = message::parse_line(*line);
    if (const auto* status = std::get_if<message::ParsedStatus>(&parsed))
      write_status(out, *status);
  }
  return out.take();
}

}  // namespace cornerd::web
