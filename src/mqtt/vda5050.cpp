// SPDX-License-Identifier: MIT
#include "mqtt/vda5050.hpp"

#include <array>
#include <cmath>
#include <cstdio>
#include <ctime>

#include <nlohmann/json.hpp>

namespace cornerd::mqtt {

namespace {

using nlohmann::json;

/// Whole 0.01 mm, and 0.001 degrees: what is finer is noise, and costs bytes.
double rounded(double value) { return std::round(value * 1e5) / 1e5; }

std::string_view name_of(ActionStatus status) {
  switch (status) {
    case ActionStatus::kRunning:
      return "RUNNING";
    case ActionStatus::kFinished:
      return "FINISHED";
    case ActionStatus::kFailed:
      return "FAILED";
  }
  return "FAILED";
}

std::string text_of(const json& message) {
  return message.dump(-1, ' ', false, json::error_handler_t::replace);
}

json error_of(std::string_view type, const std::string& description, std::string_view level) {
  return {{"errorType", type},
          {"errorDescription", description},
          {"errorLevel", level},
          {"errorReferences", json::array()}};
}

json errors_of(const RobotState& robot, bool is_localized, bool is_v3) {
  json errors = json::array();
  if (!is_localized) {
    std::string why = "no pose within the limits: " + std::string(robot.state_name());
    if (!robot.is_daemon_connected) why = robot.daemon_problem;
    if (!robot.hint.empty()) why += "; " + robot.hint;
    errors.push_back(error_of("LOCALIZATION_ERROR", why, is_v3 ? "URGENT" : "WARNING"));
  }
  if (!robot.map_problem.empty()) {
    errors.push_back(error_of("MAP_REFUSED", robot.map_problem, "WARNING"));
  }
  for (const ActionState& action : robot.actions) {
    if (action.status != ActionStatus::kFailed) continue;
    json error = error_of("INVALID_INSTANT_ACTION", action.result, "WARNING");
    error["errorReferences"].push_back(
        {{"referenceKey", "actionId"}, {"referenceValue", action.id}});
    errors.push_back(std::move(error));
  }
  return errors;
}

json actions_of(const RobotState& robot, bool is_v3) {
  json states = json::array();
  for (const ActionState& action : robot.actions) {
    json state = {{"actionId", action.id},
                  {"actionType", action.type},
                  {"actionStatus", name_of(action.status)}};
    if (!action.result.empty()) state[is_v3 ? "actionResult" : "resultDescription"] = action.result;
    states.push_back(std::move(state));
  }
  return states;
}

json maps_of(const RobotState& robot) {
  json maps = json::array();
  for (const KeptMap& map : robot.maps) {
    maps.push_back({{"mapId", map.id},
                    {"mapVersion", std::to_string(map.version)},
                    {"mapStatus", map.is_in_use ? "ENABLED" : "DISABLED"}});
  }
  return maps;
}

/// The bridge knows of the localization alone: this is said, not guessed.
json information() {
  json all = json::array();
  all.push_back({{"infoType", "LOCALIZATION_ONLY"},
                 {"infoLevel", "INFO"},
                 {"infoReferences", json::array()},
                 {"infoDescription", "battery and safety are not measured"}});
  return all;
}

}  // namespace

std::string iso_time(std::chrono::system_clock::time_point time) {
  const auto since = std::chrono::floor<std::chrono::milliseconds>(time.time_since_epoch());
  const std::time_t seconds = std::chrono::floor<std::chrono::seconds>(since).count();
  std::tm parts{};
  ::gmtime_r(&seconds, &parts);
  std::array<char, 32> day{};
  const std::size_t length = std::strftime(day.data(), day.size(), "%Y-%m-%dT%H:%M:%S", &parts);
  std::array<char, 8> rest{};
  std::snprintf(rest.data(), rest.size(), ".%03dZ",
                static_cast<int>(since.count() - 1000 * static_cast<long long>(seconds)));
  return std::string(day.data(), length) + rest.data();
}

std::string Vda5050::topic(std::string_view name) const {
  return (is_v3() ? "vda5050/v3/" : "uagv/v2/") + config_.manufacturer + "/" + config_.serial +
         "/" + std::string(name);
}

json Vda5050::header(UnixTime now, std::uint32_t& count) const {
  constexpr std::array<const char*, 3> kNames = {"2.0.0", "2.1.0", "3.0.0"};
  return {{"headerId", count++},
          {"timestamp", iso_time(now)},
          {"version", kNames[static_cast<std::size_t>(config_.vda5050)]},
          {"manufacturer", config_.manufacturer},
          {"serialNumber", config_.serial}};
}

json Vda5050::position(const RobotState& robot, double now_s) const {
  const core::Pose2 T_map_base = robot.T_map_base.value_or(core::Pose2{});
  json position = {{"x", rounded(T_map_base.x_m)},
                   {"y", rounded(T_map_base.y_m)},
                   {"theta", rounded(T_map_base.theta_rad)},
                   {"mapId", robot.map_id()}};
  const bool is_localized = robot.is_localized(config_.max_deviation_m, config_.max_age_s, now_s);
  position[is_v3() ? "localized" : "positionInitialized"] = is_localized;
  if (const auto deviation = robot.deviation_m(); deviation && is_localized) {
    position["deviationRange"] = rounded(*deviation);
  }
  return position;
}

std::string Vda5050::connection(Connection state, UnixTime now) {
  json message = header(now, connections_);
  message["connectionState"] = state == Connection::kOnline    ? "ONLINE"
                               : state == Connection::kOffline ? "OFFLINE"
                               : is_v3()                       ? "CONNECTION_BROKEN"
                                                               : "CONNECTIONBROKEN";
  return text_of(message);
}

std::string Vda5050::state(const RobotState& robot, UnixTime now, double now_s) {
  json message = header(now, states_);
  json position_now = position(robot, now_s);
  const bool is_localized = position_now[is_v3() ? "localized" : "positionInitialized"];
  message.update({{"orderId", ""},
                  {"orderUpdateId", 0},
                  {"lastNodeId", robot.last_node},
                  {"lastNodeSequenceId", 0},
                  {"nodeStates", json::array()},
                  {"edgeStates", json::array()},
                  {"driving", robot.is_driving},
                  {"operatingMode", "MANUAL"},
                  {"errors", errors_of(robot, is_localized, is_v3())},
                  {"information", information()}});
  message[is_v3() ? "mobileRobotPosition" : "agvPosition"] = std::move(position_now);
  if (config_.vda5050 != VdaVersion::kV20) message["maps"] = maps_of(robot);
  if (is_v3()) {
    message["actionStates"] = json::array();
    message["instantActionStates"] = actions_of(robot, true);
    message["powerSupply"] = {{"stateOfCharge", 0}, {"charging", false}};
    message["safetyState"] = {{"activeEmergencyStop", "NONE"}, {"fieldViolation", false}};
  } else {
    message["actionStates"] = actions_of(robot, false);
    message["batteryState"] = {{"batteryCharge", 0}, {"charging", false}};
    message["safetyState"] = {{"eStop", "NONE"}, {"fieldViolation", false}};
  }
  return text_of(message);
}

std::string Vda5050::visualization(const RobotState& robot, UnixTime now, double now_s) {
  json message = header(now, visualizations_);
  message[is_v3() ? "mobileRobotPosition" : "agvPosition"] = position(robot, now_s);
  return text_of(message);
}

}  // namespace cornerd::mqtt
