// SPDX-License-Identifier: MIT
#include <array>

#include <nlohmann/json.hpp>

#include "mqtt/vda5050.hpp"

namespace cornerd::mqtt {

namespace {

using nlohmann::json;

/// The names that version 3.0 gave to what 2.x had already.
struct Names {
  const char *kinematic, *vehicle_class, *load, *min_speed, *max_speed, *acceleration,
      *deceleration, *min_height, *max_height, *string_limits, *array_limits, *order_interval,
      *state_interval, *actions, *geometry, *number, *init_position;
  std::array<const char*, 3> kinematics;
};
constexpr Names kV2{"agvKinematic",     "agvClass",
                    "maxLoadMass",      "speedMin",
                    "speedMax",         "accelerationMax",
                    "decelerationMax",  "heightMin",
                    "heightMax",        "maxStringLens",
                    "maxArrayLens",     "minOrderInterval",
                    "minStateInterval", "agvActions",
                    "agvGeometry",      "FLOAT",
                    "initPosition",     {"DIFF", "OMNI", "THREEWHEEL"}};
constexpr Names kV3{"mobileRobotKinematics", "mobileRobotClass",
                    "maximumLoadMass",       "minimumSpeed",
                    "maximumSpeed",          "maximumAcceleration",
                    "maximumDeceleration",   "minimumHeight",
                    "maximumHeight",         "maximumStringLengths",
                    "maximumArrayLengths",   "minimumOrderInterval",
                    "minimumStateInterval",  "mobileRobotActions",
                    "mobileRobotGeometry",   "NUMBER",
                    "initializePosition",    {"DIFFERENTIAL", "OMNIDIRECTIONAL", "THREE_WHEEL"}};

json action(const char* type, json parameters, bool is_v3) {
  json entry = {{"actionType", type},
                {"actionScopes", json::array({"INSTANT"})},
                {"actionParameters", std::move(parameters)}};
  if (is_v3) {
    entry["pauseAllowed"] = "false";
    entry["cancelAllowed"] = "false";
  }
  return entry;
}

json parameter(const char* key, const char* type, bool is_optional) {
  return {{"key", key}, {"valueDataType", type}, {"isOptional", is_optional}};
}

json actions(const Names& names, bool is_v3) {
  json position = json::array();
  for (const char* const key : {"x", "y", "theta"}) {
    position.push_back(parameter(key, names.number, false));
  }
  for (const char* const key : {"mapId", "lastNodeId"}) {
    position.push_back(parameter(key, "STRING", true));
  }
  // Not {...}: compilers differ in whether one element in braces is an array.
  json all = json::array();
  all.push_back(action(names.init_position, std::move(position), is_v3));
  for (const char* const type : {"stateRequest", "factsheetRequest", "clearInstantActions"}) {
    all.push_back(action(type, json::array(), is_v3));
  }
  return all;
}

}  // namespace

std::string Vda5050::factsheet(UnixTime now) {
  const Names& names = is_v3() ? kV3 : kV2;
  const VehicleConfig& vehicle = config_.vehicle;
  json message = header(now, factsheets_);
  message["typeSpecification"] = {
      {"seriesName", vehicle.series},
      {names.kinematic, names.kinematics[static_cast<std::size_t>(vehicle.kinematics)]},
      {names.vehicle_class, vehicle.vehicle_class},
      {names.load, vehicle.max_load_kg},
      {"localizationTypes", json::array({"NATURAL"})},
      {"navigationTypes", json::array({"AUTONOMOUS"})}};
  message["physicalParameters"] = {{names.min_speed, 0},
                                   {names.max_speed, vehicle.max_speed_m_s},
                                   {names.acceleration, vehicle.max_acceleration_m_s2},
                                   {names.deceleration, vehicle.max_acceleration_m_s2},
                                   {names.min_height, vehicle.height_m},
                                   {names.max_height, vehicle.height_m},
                                   {"width", vehicle.width_m},
                                   {"length", vehicle.length_m}};
  message["protocolLimits"] = {
      {names.string_limits, json::object()},
      {names.array_limits, json::object()},
      {"timing", {{names.order_interval, 1}, {names.state_interval, 0.1}}}};
  message["protocolFeatures"] = {{"optionalParameters", json::array()},
                                 {names.actions, actions(names, is_v3())}};
  message[names.geometry] = json::object();
  message["loadSpecification"] = json::object();
  return message.dump(-1, ' ', false, json::error_handler_t::replace);
}

}  // namespace cornerd::mqtt
