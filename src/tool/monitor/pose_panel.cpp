// SPDX-License-Identifier: MIT
#include "tool/monitor/pose_panel.hpp"

#include <algorithm>
#include <cmath>

#include "message/line_writer.hpp"
#include "tool/drawing/text_table.hpp"

namespace cornerd::tool {

namespace {

using core::PoseState;

constexpr double kDegreesPerRad = 180 / core::kPi;
constexpr std::size_t kMaxAlternatives = 3;

Style style_of(PoseState state) {
  switch (state) {
    case PoseState::kFix:
    case PoseState::kTracking:
      return Style::kGood;
    case PoseState::kPredicted:
    case PoseState::kAmbiguous:
      return Style::kWarning;
    case PoseState::kLost:
      return Style::kBad;
  }
  return Style::kPlain;
}

void add_pose_values(const message::ParsedPose& pose, std::vector<PanelLine>& lines) {
  const auto sigma = [&](int row) {
    return pose.covariance ? std::sqrt(std::max(0.0, (*pose.covariance)(row, row))) : NAN;
  };
  const auto line = [&](const char* name, double value, int decimals, const char* unit,
                        double sigma_there, const char* sigma_unit) {
    std::string text = formatted("%-6s%9.*f %-3s", name, decimals, value, unit);
    if (std::isfinite(sigma_there)) text += formatted(" +- %.2f %s", sigma_there, sigma_unit);
    lines.push_back({text});
  };
  line("x", pose.T_map_base->x_m, 3, "m", 1000 * sigma(0), "mm");
  line("y", pose.T_map_base->y_m, 3, "m", 1000 * sigma(1), "mm");
  line("theta", pose.T_map_base->theta_rad * kDegreesPerRad, 2, "deg", sigma(2) * kDegreesPerRad,
       "deg");
}

void add_alternatives(const message::ParsedPose& pose, std::vector<PanelLine>& lines) {
  for (std::size_t i = 0; i < std::min(pose.alternatives.size(), kMaxAlternatives); ++i) {
    const core::Alternative& place = pose.alternatives[i];
    lines.push_back(
        {formatted("? %.2f, %.2f m %4.0f deg  %.2f", place.T_map_base.x_m, place.T_map_base.y_m,
                   place.T_map_base.theta_rad * kDegreesPerRad, place.score),
         Style::kWarning});
  }
}

/// `silence_s`: since it came.
void add_pose(const message::ParsedPose& pose, double silence_s, std::vector<PanelLine>& lines) {
  if (pose.T_map_base) {
    add_pose_values(pose, lines);
  } else {
    add_alternatives(pose, lines);
  }
  lines.push_back(
      {formatted("corners %llu, inliers %llu", static_cast<unsigned long long>(pose.corners),
                 static_cast<unsigned long long>(pose.inliers))});
  std::string fit;
  if (pose.rmse_m) fit = formatted("rmse %.1f mm  ", 1000 * *pose.rmse_m);
  if (pose.age_s) fit += formatted("age %.1f s", *pose.age_s + silence_s);
  if (!fit.empty()) lines.push_back({fit});
  if (pose.T_map_base && pose.p_wrong > 0.0)
    lines.push_back({formatted("wrong once in %.0f", 1 / *pose.p_wrong)});
}

void add_rates(const MonitorState& state, core::TimeNs now_ns, std::vector<PanelLine>& lines) {
  const auto& status = state.status();
  std::string scans;
  if (const auto rate_hz = state.pose_rate_hz(now_ns))
    scans = formatted("poses %.1f/s  ", *rate_hz);
  if (status && status->rate_hz) scans += formatted("scans %.1f/s", *status->rate_hz);
  if (!scans.empty()) lines.push_back({scans});
  if (status && status->samples_hz) {
    lines.push_back({formatted("samples %.0f/s", *status->samples_hz)});
  }
  if (status && status->latency_p50_s && status->latency_p99_s) {
    lines.push_back({formatted("latency %.1f ms, 99 %%: %.1f ms", 1000 * *status->latency_p50_s,
                               1000 * *status->latency_p99_s)});
  }
  std::string shares;
  for (const PoseState one : {PoseState::kFix, PoseState::kTracking, PoseState::kPredicted,
                              PoseState::kAmbiguous, PoseState::kLost}) {
    if (const std::size_t count = state.recent(one); count > 0) {
      shares += formatted(" %zu %s", count, std::string(message::to_string(one)).c_str());
    }
  }
  if (!shares.empty()) lines.push_back({formatted("last %zu:", state.recent()) + shares});
}

void add_devices(const message::ParsedStatus& status, std::vector<PanelLine>& lines) {
  const bool runs = status.lidar_state == "running" && status.lidar_fault.empty();
  lines.push_back({"lidar " + status.lidar_state, runs ? Style::kGood : Style::kBad});
  std::string about;
  for (const std::string& word :
       {status.lidar_model, status.lidar_firmware, status.lidar_mode, status.lidar_health}) {
    if (!word.empty()) about += (about.empty() ? "" : " ") + word;
  }
  if (!about.empty()) lines.push_back({about, Style::kDim});
  if (!status.odometry_state.empty()) lines.push_back({"odometry " + status.odometry_state});
}

/// Time of the daemon's last message, by its clock.
double daemon_time_s(const MonitorState& state) {
  double latest_s = -INFINITY;
  if (state.pose()) latest_s = core::to_seconds(state.pose()->t_ns);
  if (state.status()) latest_s = std::max(latest_s, core::to_seconds(state.status()->t_ns));
  return latest_s;
}

void add_events(const MonitorState& state, std::vector<PanelLine>& lines) {
  const double now_s = daemon_time_s(state);
  for (const message::ParsedEvent& event : state.events()) {
    const double age_s = now_s - core::to_seconds(event.t_ns);
    lines.push_back(
        {formatted("%6s  ", age_text(std::isfinite(age_s) ? std::max(0.0, age_s) : NAN).c_str()) +
             (event.what == "state change" ? event.detail : event.what),
         Style::kDim});
  }
}

}  // namespace

std::string age_text(double seconds) {
  if (!(seconds >= 0)) return "";
  if (seconds < 100) return formatted("%.0f s", std::floor(seconds));
  if (seconds < 6000) return formatted("%.0f min", std::floor(seconds / 60));
  return formatted("%.0f h", std::floor(seconds / 3600));
}

PanelLine state_line(const MonitorState& state, core::TimeNs now_ns) {
  if (!state.pose()) return {state.is_connected() ? "no pose yet" : "no daemon", Style::kBad};
  const message::ParsedPose& pose = *state.pose();
  const std::string text =
      std::string(message::to_string(pose.state)) + (pose.room.empty() ? "" : "  " + pose.room);
  if (state.is_pose_stale(now_ns)) return {"stale " + text, Style::kDim};
  return {text, style_of(pose.state)};
}

std::vector<PanelLine> panel_lines(const MonitorState& state, core::TimeNs now_ns) {
  std::vector<PanelLine> lines = {state_line(state, now_ns)};
  const auto gap = [&] {
    if (!lines.back().text.empty()) lines.push_back({});
  };
  if (state.pose()) add_pose(*state.pose(), state.pose_silence_s(now_ns), lines);
  if (state.is_pose_stale(now_ns)) {
    for (PanelLine& line : lines) line.style = Style::kDim;
  }
  gap();
  add_rates(state, now_ns, lines);
  gap();
  if (state.status()) add_devices(*state.status(), lines);
  gap();
  add_events(state, lines);
  return lines;
}

}  // namespace cornerd::tool
