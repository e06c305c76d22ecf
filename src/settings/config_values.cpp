// SPDX-License-Identifier: MIT
#include <sys/un.h>

#include <algorithm>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "settings/config_table.hpp"

namespace cornerd::settings {
namespace {

using Ordered = nlohmann::ordered_json;

constexpr std::size_t kMaxTextBytes = 64;
constexpr std::size_t kMaxSocketBytes = sizeof(sockaddr_un::sun_path) - 1;

constexpr Choice<rplidar::MotorKind> kMotorsByName[] = {{"dtr", rplidar::MotorKind::kDtr},
                                                        {"none", rplidar::MotorKind::kNone}};
constexpr Choice<rplidar::MotorKind> kMotorsByPath[] = {{"gpio", rplidar::MotorKind::kGpio},
                                                        {"pwm", rplidar::MotorKind::kPwm}};

}  // namespace

Value number(double& member, double low, double high, std::string_view unit) {
  return {[&member, low, high, unit](ObjectReader& object, std::string_view key) {
            object.number(key, member, {low, high, unit});
          },
          [&member] { return Ordered(member); }, to_text(low) + " to " + to_text(high)};
}

Value boolean(bool& member) {
  return {[&member](ObjectReader& object, std::string_view key) { object.boolean(key, member); },
          [&member] { return Ordered(member); }, "true, false"};
}

Value text(std::string& member) {
  return {[&member](ObjectReader& object, std::string_view key) {
            object.text(key, member, kMaxTextBytes);
          },
          [&member] { return Ordered(member); },
          "a string of at most " + std::to_string(kMaxTextBytes) + " bytes"};
}

Value path(std::filesystem::path& member) {
  return {[&member](ObjectReader& object, std::string_view key) { object.path(key, member); },
          [&member] { return Ordered(member.string()); }, "a path"};
}

Value socket_path(std::filesystem::path& member) {
  Value value = path(member);
  value.read = [&member](ObjectReader& object, std::string_view key) {
    object.path(key, member);
    if (member.native().size() <= kMaxSocketBytes) return;
    object.fail(key, "a socket's path has at most " + std::to_string(kMaxSocketBytes) +
                         " bytes: " + member.string());
  };
  return value;
}

Value named_maps(std::vector<NamedMap>& maps) {
  const auto read = [&maps](ObjectReader& object, std::string_view key) {
    const Json* value = object.find(key);
    if (value == nullptr) return;
    if (!value->is_array()) object.fail(key, "must be a list of objects with name and file");
    maps.clear();
    for (std::size_t i = 0; i < value->size(); ++i) {
      ObjectReader element = object.element(key, *value, i);
      NamedMap map;
      if (!element.text("name", map.name, kMaxTextBytes)) object.fail(key, i, "has no name");
      if (!element.path("file", map.file)) object.fail(key, i, "has no file");
      element.finish();
      if (map.name == kAutoMap) object.fail(key, i, "has the name \"auto\", which is reserved");
      const auto has_name = [&](const NamedMap& other) { return other.name == map.name; };
      if (std::any_of(maps.begin(), maps.end(), has_name))
        object.fail(key, i, "has another's name");
      maps.push_back(std::move(map));
    }
  };
  const auto write = [&maps] {
    Ordered list = Ordered::array();
    for (const NamedMap& map : maps) {
      list.push_back({{"name", map.name}, {"file", map.file.string()}});
    }
    return list;
  };
  return {read, write, "a list of { \"name\", \"file\" }"};
}

Value baud_rate(std::uint32_t& baud) {
  const std::string limits =
      "\"auto\", or " + std::to_string(kMinBaud) + " to " + std::to_string(kMaxBaud);
  return {[&baud, limits](ObjectReader& object, std::string_view key) {
            const Json* value = object.find(key);
            if (value != nullptr && *value == "auto") {
              baud = 0;
              return;
            }
            const bool is_known = value == nullptr || value->is_number_unsigned();
            if (is_known && !object.integer(key, baud, 0U, ~0U)) return;
            if (!is_known || baud < kMinBaud || baud > kMaxBaud) {
              object.fail(key, "must be " + limits);
            }
          },
          [&baud] { return baud == 0 ? Ordered("auto") : Ordered(baud); }, limits};
}

Value replay_speed(double& speed) {
  return {[&speed](ObjectReader& object, std::string_view key) {
            const Json* value = object.find(key);
            if (value != nullptr && *value == "max") {
              speed = 0;
            } else if (value != nullptr && value->is_string()) {
              object.fail(key, "must be a number from 0.001 to 1000, or \"max\"");
            } else {
              object.number(key, speed, {0.001, 1000});
            }
          },
          [&speed] { return speed == 0 ? Ordered("max") : Ordered(speed); },
          "0.001 to 1000, \"max\""};
}

/// A name, or an object where a line of the board switches the motor.
Value motor(rplidar::MotorConfig& config) {
  const auto read = [&config](ObjectReader& lidar, std::string_view key) {
    const Json* value = lidar.find(key);
    if (value == nullptr) return;
    if (!value->is_object()) {
      lidar.choice(key, config.kind, kMotorsByName);
      return;
    }
    ObjectReader object = lidar.object(key);
    if (!object.choice("kind", config.kind, kMotorsByPath)) object.fail("kind", "is missing");
    if (!object.path("path", config.path)) object.fail("path", "is missing");
    if (config.kind == rplidar::MotorKind::kPwm) {
      object.number("duty", config.duty, {0, 1});
      object.number("period", config.period_s, {1e-6, 1});
    }
    object.finish();
  };
  const auto write = [&config]() -> Ordered {
    if (config.kind == rplidar::MotorKind::kDtr) return "dtr";
    if (config.kind == rplidar::MotorKind::kNone) return "none";
    const bool is_pwm = config.kind == rplidar::MotorKind::kPwm;
    Ordered object = {{"kind", is_pwm ? "pwm" : "gpio"}, {"path", config.path.string()}};
    if (is_pwm) object.update({{"duty", config.duty}, {"period", config.period_s}});
    return object;
  };
  return {read, write, "\"dtr\", \"none\", or an object"};
}

}  // namespace cornerd::settings
