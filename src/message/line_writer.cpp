// SPDX-License-Identifier: MIT
// All messages but STATUS.
#include "message/line_writer.hpp"

#include <cmath>

#include "core/geometry/angle.hpp"
#include "core/geometry/pose2.hpp"
#include "core/map/wall_map.hpp"
#include "core/scan.hpp"

namespace cornerd::message {
namespace {

/// 10240 samples of at most 10 + 9 + 4 + 9 characters each, plus the other fields.
constexpr std::size_t kMaxLineBytes = 400 * 1024;

/// 0.01 mm; the lidar's own resolution is 0.25 mm.
constexpr int kMetreDecimals = 5;

void write_metres(JsonText& json, std::string_view name, double value_m) {
  json.number(name, value_m, kMetreDecimals);
}

void write_angle(JsonText& json, std::string_view name, double value_rad) {
  if (!std::isfinite(value_rad)) return;
  json.key(name);
  json.angle(core::normalize_angle(value_rad));
}

void write_pose(JsonText& json, const core::Pose2& T_map_base) {
  write_metres(json, "x", T_map_base.x_m);
  write_metres(json, "y", T_map_base.y_m);
  write_angle(json, "theta", T_map_base.theta_rad);
}

void write_covariance(JsonText& json, const core::Covariance3& covariance) {
  if (!covariance.allFinite()) return;
  json.open_object("cov");
  json.significant("xx", covariance(0, 0));
  json.significant("xy", covariance(0, 1));
  json.significant("xt", covariance(0, 2));
  json.significant("yy", covariance(1, 1));
  json.significant("yt", covariance(1, 2));
  json.significant("tt", covariance(2, 2));
  json.close_object();
}

/// `map_of`: the name of an alternative's map, or empty.
void write_alternatives(JsonText& json, std::span<const core::Alternative> alternatives,
                        const auto& map_of) {
  if (alternatives.empty()) return;
  json.open_array("alternatives");
  for (const core::Alternative& alternative : alternatives) {
    json.open_object();
    write_pose(json, alternative.T_map_base);
    json.number("score", alternative.score, 4);
    json.text("map", map_of(alternative));
    json.close_object();
  }
  json.close_array();
}

/// Offset of a sample from SCAN.t if the samples are evenly spaced. A scan lasts one sample period
/// longer than the time from its first to its last sample.
double even_offset_s(double duration_s, std::size_t index, std::size_t count) {
  return duration_s * static_cast<double>(index) / static_cast<double>(count);
}

double duration_of(const core::Scan& scan) {
  if (scan.size() < 2) return 0;
  const double first_to_last_s = core::to_seconds(scan.end_ns() - scan.start_ns());
  return first_to_last_s * static_cast<double>(scan.size()) / static_cast<double>(scan.size() - 1);
}

bool is_spread_evenly(const core::Scan& scan, double duration_s) {
  const auto samples = scan.samples();
  const double half_period_s = duration_s / static_cast<double>(scan.size()) / 2;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const double offset_s = core::to_seconds(samples[i].t_ns - scan.start_ns());
    if (std::abs(offset_s - even_offset_s(duration_s, i, samples.size())) > half_period_s) {
      return false;
    }
  }
  return true;
}

double finite_or_zero(double value) { return std::isfinite(value) ? value : 0; }

void write_samples(JsonText& json, std::string_view name, const core::Scan& scan,
                   const auto& write) {
  json.open_array(name);
  for (const core::Sample& sample : scan.samples()) write(sample);
  json.close_array();
}

void write_wall(JsonText& json, std::string_view wall, double bearing_rad, std::string_view support,
                int samples) {
  write_angle(json, wall, bearing_rad);
  json.integer(support, samples);
}

void write_breakpoint(JsonText& json, const core::Breakpoint& point) {
  json.open_object();
  write_metres(json, "x", point.position.x());
  write_metres(json, "y", point.position.y());
  json.string("kind", to_string(point.kind));
  if (point.kind == core::BreakpointKind::kCorner && std::isfinite(point.opening_rad)) {
    // An opening angle is in (0, 2 pi), so it is not normalized to (-pi, pi].
    json.number("angle", point.opening_rad, 6);
    json.boolean("convex", point.convex);
  }
  if (point.wall_on_right) {
    write_wall(json, "right_wall", point.right_wall_rad, "right_support", point.right_support);
  }
  if (point.wall_on_left) {
    write_wall(json, "left_wall", point.left_wall_rad, "left_support", point.left_support);
  }
  if (point.covariance.allFinite()) {
    json.open_object("cov");
    json.significant("xx", point.covariance(0, 0));
    json.significant("xy", point.covariance(0, 1));
    json.significant("yy", point.covariance(1, 1));
    json.close_object();
  }
  json.close_object();
}

}  // namespace

LineWriter::LineWriter() : json_(kMaxLineBytes) {}

void LineWriter::begin(std::string_view message_class) {
  json_.clear();
  json_.open_object();
  json_.string("class", message_class);
}

std::string_view LineWriter::finish() {
  json_.close_object();
  json_.end_line();
  return json_.view();
}

void LineWriter::id(std::string_view id_json) {
  if (!id_json.empty()) json_.raw("id", id_json);
}

std::string_view LineWriter::version(std::string_view program, std::string_view version) {
  begin("VERSION");
  json_.string("program", program);
  json_.string("version", version);
  json_.integer("schema", kSchema);
  return finish();
}

std::string_view LineWriter::event(core::TimeNs t_ns, std::string_view what,
                                   std::string_view detail) {
  begin("EVENT");
  json_.seconds("t", t_ns);
  json_.string("what", what);
  json_.text("detail", detail);
  return finish();
}

std::string_view LineWriter::ok(std::string_view request, std::string_view id_json) {
  begin("OK");
  json_.string("request", request);
  id(id_json);
  return finish();
}

std::string_view LineWriter::error(std::string_view code, std::string_view text,
                                   std::string_view request, std::string_view id_json) {
  begin("ERROR");
  json_.string("code", code);
  json_.string("message", text);
  json_.text("request", request);
  id(id_json);
  return finish();
}

std::string_view LineWriter::serial(core::TimeNs t_ns, Direction direction,
                                    std::span<const std::uint8_t> bytes) {
  begin("SERIAL");
  json_.seconds("t", t_ns);
  json_.key(direction == Direction::kRx ? "rx" : "tx");
  json_.hex(bytes);
  return finish();
}

std::string_view LineWriter::odometry(const core::OdometryReading& reading) {
  begin("ODOMETRY");
  json_.seconds("t", reading.t_ns);
  if (reading.left) json_.integer("left", *reading.left);
  if (reading.right) json_.integer("right", *reading.right);
  if (reading.gyro_rad_s) json_.number("gyro", *reading.gyro_rad_s, 6);
  return finish();
}

std::string_view LineWriter::odom(const core::OdometryPose& pose) {
  begin("ODOM");
  json_.seconds("t", pose.t_ns);
  write_pose(json_, pose.T_odom_base);
  write_metres(json_, "vx", pose.vx_m_s);
  json_.number("omega", pose.omega_rad_s, 6);
  return finish();
}

std::string_view LineWriter::truth(core::TimeNs t_ns, const core::Pose2& T_map_base) {
  json_.clear();
  json_.open_object();
  json_.seconds("t", t_ns);
  write_pose(json_, T_map_base);
  return finish();
}

std::string_view LineWriter::pose(const core::PoseEstimate& pose, const core::FloorPlan* plan,
                                  std::span<const std::string> map_names) {
  const bool publishes_pose =
      pose.state != core::PoseState::kAmbiguous && pose.state != core::PoseState::kLost;
  begin("POSE");
  json_.integer("seq", pose.seq);
  json_.seconds("t", pose.t_ns);
  json_.string("state", to_string(pose.state));
  if (publishes_pose) {
    write_pose(json_, pose.T_map_base);
    write_covariance(json_, pose.covariance);
    if (!map_names.empty() && plan != nullptr) json_.string("map", plan->name);
    if (pose.room && plan != nullptr && *pose.room < plan->rooms.size()) {
      json_.string("room", plan->rooms[*pose.room].name);
    }
  }
  json_.integer("corners", pose.corners);
  json_.integer("inliers", pose.inliers);
  if (publishes_pose && pose.inliers > 0) write_metres(json_, "rmse", pose.rmse_m);
  json_.number("age", pose.age_s, kTimeDecimals);
  const bool names_places = core::has_pose(pose.state) || !pose.alternatives.empty();
  if (names_places) json_.significant("p_wrong", pose.p_wrong);
  write_alternatives(json_, pose.alternatives, [&](const core::Alternative& alternative) {
    if (map_names.empty()) return std::string_view();
    return std::string_view(plan != nullptr ? plan->name : map_names[alternative.map]);
  });
  return finish();
}

std::string_view LineWriter::scan(const core::Scan& scan) {
  const double duration_s = duration_of(scan);
  begin("SCAN");
  json_.seconds("t", scan.start_ns());
  json_.key("duration");
  json_.fixed(duration_s, kTimeDecimals);
  write_samples(json_, "angles", scan, [this](const core::Sample& sample) {
    json_.angle(finite_or_zero(sample.bearing_rad));
  });
  write_samples(json_, "ranges", scan, [this](const core::Sample& sample) {
    json_.fixed(finite_or_zero(sample.range_m), kMetreDecimals);
  });
  write_samples(json_, "quality", scan, [this](const core::Sample& sample) {
    json_.integer(static_cast<unsigned>(sample.quality));
  });
  if (!is_spread_evenly(scan, duration_s)) {
    write_samples(json_, "times", scan, [this, &scan](const core::Sample& sample) {
      json_.fixed(core::to_seconds(sample.t_ns - scan.start_ns()), kTimeDecimals);
    });
  }
  return finish();
}

std::string_view LineWriter::breakpoints(core::TimeNs t_ns, const core::Detection& detection) {
  begin("BREAKPOINTS");
  json_.seconds("t", t_ns);
  json_.open_array("points");
  for (const core::Breakpoint& point : detection.breakpoints) write_breakpoint(json_, point);
  json_.close_array();
  return finish();
}

std::string_view to_string(core::PoseState state) {
  switch (state) {
    case core::PoseState::kFix:
      return "fix";
    case core::PoseState::kTracking:
      return "tracking";
    case core::PoseState::kPredicted:
      return "predicted";
    case core::PoseState::kAmbiguous:
      return "ambiguous";
    case core::PoseState::kLost:
      return "lost";
  }
  return "lost";
}

std::string_view to_string(core::BreakpointKind kind) {
  return kind == core::BreakpointKind::kCorner ? "corner" : "terminal";
}

}  // namespace cornerd::message
