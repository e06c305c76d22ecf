// SPDX-License-Identifier: MIT
#include "message/line.hpp"

#include <cmath>
#include <cstdlib>

#include "message/state_names.hpp"

namespace cornerd::message {
namespace {

/// 10240 samples of at most 10 + 9 + 4 + 9 characters each, with room for the rest.
constexpr std::size_t kLongestLine = 400 * 1024;

/// A hundredth of a millimetre: the wire's own step is a quarter of one.
constexpr int kMetreDecimals = 5;
constexpr int kTimeDecimals = 6;

/// A sample's offset from SCAN.t where the samples are spread evenly: the turn lasts one sample
/// period longer than from its first sample to its last.
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

}  // namespace

LineWriter::LineWriter() : json_(kLongestLine) {}

void LineWriter::begin(std::string_view message_class) {
  json_.clear();
  json_.open_object();
  json_.key("class");
  json_.string(message_class);
}

std::string_view LineWriter::finish() {
  json_.close_object();
  json_.end_line();
  return json_.view();
}

void LineWriter::metres(std::string_view key, double value_m) {
  if (!std::isfinite(value_m)) return;
  json_.key(key);
  json_.fixed(value_m, kMetreDecimals);
}

void LineWriter::angle(std::string_view key, double value_rad) {
  if (!std::isfinite(value_rad)) return;
  json_.key(key);
  json_.angle(core::normalize_angle(value_rad));
}

void LineWriter::place(const core::Pose2& T_map_base) {
  metres("x", T_map_base.x_m);
  metres("y", T_map_base.y_m);
  angle("theta", T_map_base.theta_rad);
}

std::string_view LineWriter::version(std::string_view program, std::string_view version) {
  begin("VERSION");
  json_.key("program");
  json_.string(program);
  json_.key("version");
  json_.string(version);
  json_.key("schema");
  json_.integer(kSchema);
  return finish();
}

std::string_view LineWriter::pose(const core::PoseEstimate& pose, const core::FloorPlan* plan) {
  const bool names_place =
      pose.state != core::PoseState::kAmbiguous && pose.state != core::PoseState::kLost;
  begin("POSE");
  json_.key("seq");
  json_.integer(pose.seq);
  json_.key("t");
  json_.seconds(pose.t_ns);
  json_.key("state");
  json_.string(to_string(pose.state));
  if (names_place) {
    place(pose.T_map_base);
    if (pose.covariance.allFinite()) {
      const auto entry = [this, &pose](std::string_view key, int row, int column) {
        json_.key(key);
        json_.significant(pose.covariance(row, column));
      };
      json_.key("cov");
      json_.open_object();
      entry("xx", 0, 0);
      entry("xy", 0, 1);
      entry("xt", 0, 2);
      entry("yy", 1, 1);
      entry("yt", 1, 2);
      entry("tt", 2, 2);
      json_.close_object();
    }
    if (pose.room && plan != nullptr && *pose.room < plan->rooms.size()) {
      json_.key("room");
      json_.string(plan->rooms[*pose.room].name);
    }
  }
  json_.key("corners");
  json_.integer(pose.corners);
  json_.key("inliers");
  json_.integer(pose.inliers);
  if (names_place && pose.inliers > 0) metres("rmse", pose.rmse_m);
  if (std::isfinite(pose.age_s)) {
    json_.key("age");
    json_.fixed(pose.age_s, kTimeDecimals);
  }
  if (!pose.alternatives.empty()) {
    json_.key("alternatives");
    json_.open_array();
    for (const core::Alternative& alternative : pose.alternatives) {
      json_.open_object();
      place(alternative.T_map_base);
      if (std::isfinite(alternative.score)) {
        json_.key("score");
        json_.fixed(alternative.score, 4);
      }
      json_.close_object();
    }
    json_.close_array();
  }
  return finish();
}

std::string_view LineWriter::scan(const core::Scan& scan) {
  const double duration_s = duration_of(scan);
  begin("SCAN");
  json_.key("t");
  json_.seconds(scan.start_ns());
  json_.key("duration");
  json_.fixed(duration_s, kTimeDecimals);
  json_.key("angles");
  json_.open_array();
  for (const core::Sample& sample : scan.samples()) json_.angle(finite_or_zero(sample.bearing_rad));
  json_.close_array();
  json_.key("ranges");
  json_.open_array();
  for (const core::Sample& sample : scan.samples()) {
    json_.fixed(finite_or_zero(sample.range_m), kMetreDecimals);
  }
  json_.close_array();
  json_.key("quality");
  json_.open_array();
  for (const core::Sample& sample : scan.samples()) {
    json_.integer(static_cast<unsigned>(sample.quality));
  }
  json_.close_array();
  if (!is_spread_evenly(scan, duration_s)) {
    json_.key("times");
    json_.open_array();
    for (const core::Sample& sample : scan.samples()) {
      json_.fixed(core::to_seconds(sample.t_ns - scan.start_ns()), kTimeDecimals);
    }
    json_.close_array();
  }
  return finish();
}

std::string_view LineWriter::breakpoints(core::TimeNs t_ns, const core::Detection& detection) {
  begin("BREAKPOINTS");
  json_.key("t");
  json_.seconds(t_ns);
  json_.key("points");
  json_.open_array();
  for (const core::Breakpoint& point : detection.breakpoints) {
    const bool is_corner = point.kind == core::BreakpointKind::kCorner;
    json_.open_object();
    metres("x", point.position.x());
    metres("y", point.position.y());
    json_.key("kind");
    json_.string(to_string(point.kind));
    if (is_corner && std::isfinite(point.opening_rad)) {
      // An opening runs to 2 pi, so it is no direction to be brought into (-pi, pi].
      json_.key("angle");
      json_.fixed(point.opening_rad, 6);
      json_.key("convex");
      json_.boolean(point.convex);
    }
    if (point.wall_on_right) {
      angle("right_wall", point.right_wall_rad);
      json_.key("right_support");
      json_.integer(point.right_support);
    }
    if (point.wall_on_left) {
      angle("left_wall", point.left_wall_rad);
      json_.key("left_support");
      json_.integer(point.left_support);
    }
    if (point.covariance.allFinite()) {
      json_.key("cov");
      json_.open_object();
      json_.key("xx");
      json_.significant(point.covariance(0, 0));
      json_.key("xy");
      json_.significant(point.covariance(0, 1));
      json_.key("yy");
      json_.significant(point.covariance(1, 1));
      json_.close_object();
    }
    json_.close_object();
  }
  json_.close_array();
  return finish();
}

void LineWriter::odometry_summary(const core::OdometrySummary& odometry) {
  const auto learned = [this](const core::LearnedOdometry& values) {
    const std::pair<std::string_view, double> named[] = {{"gyro_bias", values.gyro_bias_rad_s},
                                                         {"gyro_scale", values.gyro_scale},
                                                         {"left_scale", values.left_scale},
                                                         {"right_scale", values.right_scale},
                                                         {"track_scale", values.track_scale}};
    for (const auto& [key, value] : named) {
      if (!std::isfinite(value)) continue;
      json_.key(key);
      json_.fixed(value, kTimeDecimals);
    }
  };
  const core::OdometryCounters& refused = odometry.counters;
  const std::pair<std::string_view, std::uint64_t> counters[] = {
      {"readings", refused.readings}, {"past", refused.past},           {"future", refused.future},
      {"jumps", refused.jumps},       {"bad_rates", refused.gyro},      {"frozen", refused.frozen},
      {"holes", refused.holes},       {"restarts", refused.restarts},   {"slips", odometry.slips},
      {"fixes", odometry.fixes},      {"strangers", odometry.strangers}};
  json_.key("odometry");
  json_.open_object();
  json_.key("state");
  json_.string(!odometry.present ? "absent" : odometry.trusted ? "running" : "distrusted");
  learned(odometry.learned);
  json_.key("sigma");
  json_.open_object();
  learned(odometry.sigma);
  json_.close_object();
  json_.key("counters");
  json_.open_object();
  for (const auto& [key, value] : counters) {
    json_.key(key);
    json_.integer(value);
  }
  json_.close_object();
}

void LineWriter::odometry_sensors(const StatusFields& status) {
  if (status.odometry_sensors.empty()) return;
  json_.key("sensors");
  json_.open_object();
  for (const StatusFields::Sensor& sensor : status.odometry_sensors) {
    json_.key(sensor.name);
    json_.open_object();
    json_.key("state");
    json_.string(sensor.state);
    if (!sensor.detail.empty()) {
      json_.key("detail");
      json_.string(sensor.detail);
    }
    json_.close_object();
  }
  json_.key("counters");
  json_.open_object();
  for (const StatusFields::Counter& counter : status.odometry_counters) {
    json_.key(counter.name);
    json_.integer(counter.value);
  }
  json_.close_object();
  json_.close_object();
}

std::string_view LineWriter::status(const StatusFields& status) {
  const auto text = [this](std::string_view key, std::string_view value) {
    if (value.empty()) return;
    json_.key(key);
    json_.string(value);
  };
  const auto number = [this](std::string_view key, double value, int decimals) {
    if (!std::isfinite(value)) return;
    json_.key(key);
    json_.fixed(value, decimals);
  };
  begin("STATUS");
  json_.key("t");
  json_.seconds(status.t_ns);
  json_.key("lidar");
  json_.open_object();
  text("state", status.lidar_state);
  text("fault", status.lidar_fault);
  text("detail", status.lidar_detail);
  text("model", status.lidar_model);
  text("firmware", status.lidar_firmware);
  text("health", status.lidar_health);
  text("mode", status.lidar_mode);
  number("rate_hz", status.rate_hz, 3);
  number("samples_hz", status.samples_hz, 1);
  json_.close_object();
  json_.key("counters");
  json_.open_object();
  for (const StatusFields::Counter& counter : status.counters) {
    json_.key(counter.name);
    json_.integer(counter.value);
  }
  json_.close_object();
  if (status.odometry != nullptr &&
      (status.odometry->enabled || !status.odometry_sensors.empty())) {
    odometry_summary(*status.odometry);
    odometry_sensors(status);
    json_.close_object();
  }
  if (status.latency.valid) {
    json_.key("latency");
    json_.open_object();
    number("p50", status.latency.p50_s, kTimeDecimals);
    number("p95", status.latency.p95_s, kTimeDecimals);
    number("p99", status.latency.p99_s, kTimeDecimals);
    json_.close_object();
  }
  if (!status.loops.empty()) loops(status);
  return finish();
}

void LineWriter::loops(const StatusFields& status) {
  json_.key("realtime");
  json_.open_object();
  json_.key("priority");
  json_.integer(status.realtime_priority);
  json_.key("memory_locked");
  json_.boolean(status.memory_is_locked);
  json_.key("edges");
  json_.open_array();
  for (const core::TimeNs edge_ns : core::Lateness::kEdgesNs) {
    json_.fixed(core::to_seconds(edge_ns), kTimeDecimals);
  }
  json_.close_array();
  for (const StatusFields::Loop& loop : status.loops) {
    json_.key(loop.name);
    json_.open_object();
    json_.key("late");
    json_.open_array();
    for (const std::uint32_t count : loop.lateness->counts) json_.integer(count);
    json_.close_array();
    json_.key("max");
    json_.fixed(core::to_seconds(loop.lateness->max_ns), kTimeDecimals);
    if (loop.page_faults) {
      json_.key("page_faults");
      json_.integer(*loop.page_faults);
    }
    json_.close_object();
  }
  json_.close_object();
}

std::string_view LineWriter::event(core::TimeNs t_ns, std::string_view what,
                                   std::string_view detail) {
  begin("EVENT");
  json_.key("t");
  json_.seconds(t_ns);
  json_.key("what");
  json_.string(what);
  if (!detail.empty()) {
    json_.key("detail");
    json_.string(detail);
  }
  return finish();
}

std::string_view LineWriter::ok(std::string_view request, std::string_view id_json) {
  begin("OK");
  json_.key("request");
  json_.string(request);
  if (!id_json.empty()) {
    json_.key("id");
    json_.raw(id_json);
  }
  return finish();
}

std::string_view LineWriter::error(std::string_view code, std::string_view text,
                                   std::string_view request, std::string_view id_json) {
  begin("ERROR");
  json_.key("code");
  json_.string(code);
  json_.key("message");
  json_.string(text);
  if (!request.empty()) {
    json_.key("request");
    json_.string(request);
  }
  if (!id_json.empty()) {
    json_.key("id");
    json_.raw(id_json);
  }
  return finish();
}

std::string_view LineWriter::serial(core::TimeNs t_ns, Direction direction,
                                    std::span<const std::uint8_t> bytes) {
  begin("SERIAL");
  json_.key("t");
  json_.seconds(t_ns);
  json_.key(direction == Direction::kRx ? "rx" : "tx");
  json_.hex(bytes);
  return finish();
}

std::string_view LineWriter::odometry(const OdometryFields& odometry) {
  begin("ODOMETRY");
  json_.key("t");
  json_.seconds(odometry.t_ns);
  if (odometry.has_counts) {
    json_.key("left");
    json_.integer(odometry.left);
    json_.key("right");
    json_.integer(odometry.right);
  }
  if (odometry.has_gyro && std::isfinite(odometry.gyro_rad_s)) {
    json_.key("gyro");
    json_.fixed(odometry.gyro_rad_s, 6);
  }
  return finish();
}

std::string_view LineWriter::truth(core::TimeNs t_ns, const core::Pose2& T_map_base) {
  json_.clear();
  json_.open_object();
  json_.key("t");
  json_.seconds(t_ns);
  place(T_map_base);
  return finish();
}

}  // namespace cornerd::message
