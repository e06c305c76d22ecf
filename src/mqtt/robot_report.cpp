// SPDX-License-Identifier: MIT
#include "mqtt/robot_report.hpp"

#include "core/geometry/angle.hpp"
#include "message/field_reader.hpp"
#include "message/json_text.hpp"

namespace cornerd::mqtt {

namespace {

/// A table holds thousands of them.
constexpr std::size_t kMaxReportBytes = 2048;
constexpr std::size_t kMaxProblemBytes = 512;
constexpr message::Limits kVersionLimits{0, 9007199254740992.0};

std::string problem_of(const RobotState& robot) {
  if (!robot.is_daemon_connected) return robot.daemon_problem;
  if (!robot.map_problem.empty()) return robot.map_problem;
  return robot.hint;
}

}  // namespace

std::string robot_topic(const BridgeConfig& config) {
  return "cornerd/" + config.site + "/robot/" + config.manufacturer + "/" + config.serial;
}

RobotReport report_of(const RobotState& robot, const BridgeConfig& config, core::TimeNs t_ns,
                      double now_s) {
  RobotReport report;
  report.manufacturer = config.manufacturer;
  report.serial = config.serial;
  report.t_ns = t_ns;
  report.state = robot.state_name();
  report.is_localized = robot.is_localized(config.max_deviation_m, config.max_age_s, now_s);
  if (robot.is_daemon_connected && robot.pose) {
    report.room = robot.pose->room;
    report.T_map_base = robot.pose->T_map_base;
  }
  report.map = robot.map_id();
  report.map_version = robot.map_version();
  report.map_hash = robot.map_hash;
  report.problem = problem_of(robot);
  return report;
}

std::string robot_report_json(const RobotReport& report) {
  constexpr int kMillimetres = 3;
  message::JsonText json(512);
  json.open_object();
  json.string("manufacturer", report.manufacturer);
  json.string("serial", report.serial);
  json.seconds("t", report.t_ns);
  json.string("state", report.state);
  json.boolean("localized", report.is_localized);
  json.string("room", report.room);
  if (report.T_map_base) {
    json.number("x", report.T_map_base->x_m, kMillimetres);
    json.number("y", report.T_map_base->y_m, kMillimetres);
    json.number("theta", report.T_map_base->theta_rad, kMillimetres);
  }
  json.string("map", report.map);
  json.integer("map_version", report.map_version);
  json.text("map_hash", report.map_hash);
  json.text("problem", std::string_view(report.problem).substr(0, kMaxProblemBytes));
  json.close_object();
  return std::string(json.view());
}

std::optional<RobotReport> parse_robot_report(std::string_view payload) {
  message::RequestError error;
  const auto object = message::parse_object(payload, kMaxReportBytes, error);
  if (!object) return std::nullopt;
  message::FieldReader fields(*object);
  RobotReport report;
  report.manufacturer = fields.text("manufacturer");
  report.serial = fields.text("serial");
  report.t_ns = fields.time("t");
  report.state = fields.text("state");
  if (fields.has("localized") && (*object)["localized"].is_boolean()) {
    report.is_localized = (*object)["localized"].get<bool>();
  }
  report.room = fields.optional_text("room");
  if (fields.has("x")) {
    report.T_map_base = {fields.number("x", message::kCoordinateLimitsM),
                         fields.number("y", message::kCoordinateLimitsM),
                         core::normalize_angle(fields.number("theta", message::kAngleLimitsRad))};
  }
  report.map = fields.optional_text("map");
  report.map_version =
      static_cast<std::uint64_t>(fields.optional_number("map_version", kVersionLimits).value_or(0));
  report.map_hash = fields.optional_text("map_hash");
  report.problem = fields.optional_text("problem");
  if (fields.error()) return std::nullopt;
  return report;
}

}  // namespace cornerd::mqtt
