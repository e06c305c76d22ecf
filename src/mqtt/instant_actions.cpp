// SPDX-License-Identifier: MIT
#include "mqtt/instant_actions.hpp"

#include <charconv>

#include "core/geometry/angle.hpp"
#include "message/field_reader.hpp"

namespace cornerd::mqtt {

namespace {

using message::FieldReader;
using message::Json;

constexpr std::size_t kMaxPayloadBytes = 64 * 1024;
constexpr std::size_t kMaxParameters = 64;

/// The value of a parameter; nullptr if there is none of this key.
const Json* parameter(const Json& parameters, std::string_view key) {
  for (const Json& entry : parameters) {
    if (!entry.is_object()) continue;
    const auto name = entry.find("key");
    const auto value = entry.find("value");
    if (name != entry.end() && value != entry.end() && name->is_string() &&
        name->get_ref<const std::string&>() == key) {
      return &*value;
    }
  }
  return nullptr;
}

double number(const Json& parameters, const char* key, message::Limits limits,
              std::string& problem) {
  const Json* const value = parameter(parameters, key);
  double found = limits.high + 1;
  if (value != nullptr && value->is_number()) {
    found = value->get<double>();
  } else if (value != nullptr && value->is_string()) {
    const auto& text = value->get_ref<const std::string&>();
    double parsed = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), parsed);
    if (error == std::errc() && end == text.data() + text.size()) found = parsed;
  }
  if (found >= limits.low && found <= limits.high) return found;
  if (problem.empty()) {
    problem = std::string("the parameter ") + key + " must be a number, metres or radians";
  }
  return 0;
}

std::string text(const Json& parameters, const char* key, std::string& problem) {
  const Json* const value = parameter(parameters, key);
  if (value == nullptr) return {};
  if (value->is_string() && value->get_ref<const std::string&>().size() <= kMaxIdBytes) {
    return value->get<std::string>();
  }
  if (problem.empty()) problem = std::string("the parameter ") + key + " must be a short text";
  return {};
}

InstantAction read_action(const Json& entry, std::string& problem) {
  FieldReader fields(entry);
  InstantAction action{
      std::string(fields.text("actionId")), std::string(fields.text("actionType")), {}, {}, {}};
  if (action.id.empty() || action.id.size() > kMaxIdBytes || action.type.size() > kMaxIdBytes) {
    fields.fail("actionId and actionType must be texts of 1 to 128 bytes");
  }
  if (fields.error()) {
    problem = fields.error()->text;
    return action;
  }
  if (!is_init_position(action.type)) return action;
  const Json& parameters = fields.array("actionParameters", kMaxParameters);
  if (fields.error()) action.problem = fields.error()->text;
  action.T_map_base.x_m = number(parameters, "x", message::kCoordinateLimitsM, action.problem);
  action.T_map_base.y_m = number(parameters, "y", message::kCoordinateLimitsM, action.problem);
  action.T_map_base.theta_rad =
      core::normalize_angle(number(parameters, "theta", message::kAngleLimitsRad, action.problem));
  action.map = text(parameters, "mapId", action.problem);
  action.last_node = text(parameters, "lastNodeId", action.problem);
  return action;
}

}  // namespace

bool is_init_position(std::string_view action_type) {
  return action_type == "initPosition" || action_type == "initializePosition";
}

InstantActions parse_instant_actions(std::string_view payload) {
  InstantActions parsed;
  message::RequestError error;
  const auto object = message::parse_object(payload, kMaxPayloadBytes, error);
  if (!object) {
    parsed.problem = error.text;
    return parsed;
  }
  FieldReader fields(*object);
  // Version 1.1 and some libraries of 2.0 write "instantActions".
  const char* const name = fields.has("actions") ? "actions" : "instantActions";
  for (const Json& entry : fields.array(name, kMaxActions)) {
    InstantAction action = read_action(entry, parsed.problem);
    if (!parsed.problem.empty()) break;
    parsed.actions.push_back(std::move(action));
  }
  if (fields.error()) parsed.problem = fields.error()->text;
  if (!parsed.problem.empty()) parsed.actions.clear();
  return parsed;
}

}  // namespace cornerd::mqtt
