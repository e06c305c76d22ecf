// SPDX-License-Identifier: MIT
#include "message/parsed_line.hpp"

#include <algorithm>
#include <limits>

#include "core/scan.hpp"
#include "message/field_reader.hpp"
#include "message/input_fields.hpp"
#include "message/line_writer.hpp"
#include "message/parsed_map.hpp"

namespace cornerd::message {
namespace {

constexpr Limits kCountLimits{0, 9007199254740992.0};
constexpr Limits kProbability{0, 1};
constexpr Limits kAnyNumber{std::numeric_limits<double>::lowest(),
                            std::numeric_limits<double>::max()};
/// Bounds the memory that a hostile STATUS takes.
constexpr std::size_t kMaxEntries = 1024;

std::uint64_t read_count(FieldReader& fields, const char* name) {
  return static_cast<std::uint64_t>(fields.optional_number(name, kCountLimits).value_or(0));
}

core::Pose2 read_pose2(FieldReader& fields) {
  return {fields.number("x", kCoordinateLimitsM), fields.number("y", kCoordinateLimitsM),
          core::normalize_angle(fields.number("theta", kAngleLimitsRad))};
}

core::PoseState read_pose_state(FieldReader& fields) {
  using core::PoseState;
  const std::string_view name = fields.text("state");
  for (const PoseState state : {PoseState::kFix, PoseState::kTracking, PoseState::kPredicted,
                                PoseState::kAmbiguous, PoseState::kLost}) {
    if (to_string(state) == name) return state;
  }
  fields.fail("\"state\" is unknown");
  return PoseState::kLost;
}

core::Covariance3 read_covariance(FieldReader& fields, const Json& object) {
  FieldReader entries(object);
  const auto entry = [&](const char* name) { return entries.number(name, kAnyNumber); };
  core::Covariance3 covariance;
  covariance << entry("xx"), entry("xy"), entry("xt"),  //
      entry("xy"), entry("yy"), entry("yt"),            //
      entry("xt"), entry("yt"), entry("tt");
  if (entries.error()) fields.fail("\"cov\": " + entries.error()->text);
  return covariance;
}

ParsedLine read_pose(FieldReader& fields) {
  ParsedPose pose;
  pose.seq = read_count(fields, "seq");
  pose.t_ns = fields.time("t");
  pose.state = read_pose_state(fields);
  if (fields.has("x")) pose.T_map_base = read_pose2(fields);
  if (fields.has("cov")) pose.covariance = read_covariance(fields, fields.optional_object("cov"));
  pose.map = fields.optional_text("map");
  pose.room = fields.optional_text("room");
  pose.corners = read_count(fields, "corners");
  pose.inliers = read_count(fields, "inliers");
  pose.rmse_m = fields.optional_number("rmse", kAnyNumber);
  pose.age_s = fields.optional_number("age", kAnyNumber);
  pose.p_wrong = fields.optional_number("p_wrong", kProbability);
  if (fields.has("alternatives")) {
    for (const Json& alternative : fields.array("alternatives", core::kMaxAlternatives)) {
      FieldReader entries(alternative);
      const core::Pose2 T_map_base = read_pose2(entries);
      const double score = entries.optional_number("score", kAnyNumber).value_or(0);
      if (entries.error()) {
        fields.fail("\"alternatives\": " + entries.error()->text);
        break;
      }
      pose.alternatives.push_back({T_map_base, score});
    }
  }
  return pose;
}

ParsedLine read_breakpoints(FieldReader& fields) {
  ParsedBreakpoints breakpoints;
  breakpoints.t_ns = fields.time("t");
  for (const Json& point : fields.array("points", core::kMaxSamplesPerScan)) {
    FieldReader entries(point);
    const double x_m = entries.number("x", kCoordinateLimitsM);
    const double y_m = entries.number("y", kCoordinateLimitsM);
    const bool is_corner = entries.text("kind") == "corner";
    if (entries.error()) {
      fields.fail("\"points\": " + entries.error()->text);
      break;
    }
    breakpoints.points.push_back({{x_m, y_m}, is_corner});
  }
  return breakpoints;
}

void read_lidar(FieldReader& fields, ParsedStatus& status) {
  FieldReader lidar(fields.optional_object("lidar"));
  status.lidar_state = lidar.text("state");
  status.lidar_fault = lidar.optional_text("fault");
  status.lidar_detail = lidar.optional_text("detail");
  status.lidar_model = lidar.optional_text("model");
  status.lidar_firmware = lidar.optional_text("firmware");
  status.lidar_health = lidar.optional_text("health");
  status.lidar_mode = lidar.optional_text("mode");
  status.rate_hz = lidar.optional_number("rate_hz", kAnyNumber);
  status.samples_hz = lidar.optional_number("samples_hz", kAnyNumber);
  if (lidar.has("mount")) {
    FieldReader mount(lidar.optional_object("mount"));
    status.T_base_lidar = read_pose2(mount);
    if (mount.error()) lidar.fail("\"mount\": " + mount.error()->text);
  }
  if (lidar.error()) fields.fail("\"lidar\": " + lidar.error()->text);
}

void read_odometry(FieldReader& fields, ParsedStatus& status) {
  FieldReader odometry(fields.optional_object("odometry"));
  status.odometry_state = odometry.optional_text("state");
  status.odometry_hint = odometry.optional_text("hint");
  FieldReader counters(odometry.optional_object("counters"));
  status.odometry_readings = counters.optional_number("readings", kAnyNumber);
  if (counters.error()) odometry.fail(counters.error()->text);
  for (const auto& [name, sensor] : odometry.optional_object("sensors").items()) {
    // "counters" is an object beside the sensors.
    if (!sensor.is_object() || !sensor.contains("state")) continue;
    if (status.odometry_sensors.size() == kMaxEntries) break;
    FieldReader entries(sensor);
    status.odometry_sensors.push_back(
        {name, std::string(entries.text("state")), std::string(entries.optional_text("detail"))});
    if (entries.error()) odometry.fail(entries.error()->text);
  }
  if (odometry.error()) fields.fail("\"odometry\": " + odometry.error()->text);
}

ParsedLine read_status(FieldReader& fields) {
  ParsedStatus status;
  status.t_ns = fields.time("t");
  read_lidar(fields, status);
  for (const auto& [name, value] : fields.optional_object("counters").items()) {
    if (status.counters.size() == kMaxEntries) break;
    if (value.is_number_unsigned()) {
      status.counters.emplace_back(name, value.get<std::uint64_t>());
    }
  }
  read_odometry(fields, status);
  FieldReader latency(fields.optional_object("latency"));
  status.latency_p50_s = latency.optional_number("p50", kAnyNumber);
  status.latency_p99_s = latency.optional_number("p99", kAnyNumber);
  if (latency.error()) fields.fail("\"latency\": " + latency.error()->text);
  if (fields.has("faults")) {
    for (const Json& fault : fields.array("faults", kMaxEntries)) {
      if (fault.is_string()) status.faults.push_back(fault.get<std::string>());
    }
  }
  status.hint = fields.optional_text("hint");
  return status;
}

ParsedLine read_event(FieldReader& fields) {
  return ParsedEvent{fields.time("t"), std::string(fields.text("what")),
                     std::string(fields.optional_text("detail"))};
}

ParsedLine read_odom(FieldReader& fields) {
  return ParsedOdom{fields.time("t"), read_pose2(fields),
                    fields.optional_number("vx", kAnyNumber).value_or(0),
                    fields.optional_number("omega", kAnyNumber).value_or(0)};
}

ParsedLine read_message(std::string_view name, FieldReader& fields) {
  if (name == "VERSION") {
    return ParsedVersion{std::string(fields.text("program")), std::string(fields.text("version"))};
  }
  if (name == "POSE") return read_pose(fields);
  if (name == "SCAN") return read_scan(fields);
  if (name == "BREAKPOINTS") return read_breakpoints(fields);
  if (name == "STATUS") return read_status(fields);
  if (name == "EVENT") return read_event(fields);
  if (name == "ODOM") return read_odom(fields);
  if (name == "MAP") return ParsedMap{read_map(fields)};
  if (name == "ERROR") {
    return ParsedError{std::string(fields.text("code")),
                       std::string(fields.optional_text("message"))};
  }
  return OtherLine{std::string(name)};
}

}  // namespace

std::uint64_t ParsedStatus::counter(std::string_view name) const {
  const auto found = std::find_if(counters.begin(), counters.end(),
                                  [&](const auto& entry) { return entry.first == name; });
  return found == counters.end() ? 0 : found->second;
}

ParsedLine parse_line(std::string_view line) {
  return parse_by_class<ParsedLine>(line, kMaxMessageBytes, read_message);
}

}  // namespace cornerd::message
