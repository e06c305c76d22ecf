// SPDX-License-Identifier: MIT
#include "gridmap/map_server_yaml.hpp"

#include "gridmap/image.hpp"

#ifdef CORNERD_HAS_YAML

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <utility>

namespace cornerd::gridmap {
namespace {

constexpr double kMaxOffset_m = 10'000;
constexpr double kMaxYaw_rad = 1000;

bool is_control(char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; }

/// The file's keys. Known ones are taken out, so that the unknown ones remain.
class KeyReader {
 public:
  explicit KeyReader(const YAML::Node& root) {
    if (!root.IsMap()) throw GridError("has no `key: value` lines: name the yaml, not the picture");
    for (const auto& entry : root) {
      if (!entry.first.IsScalar()) {
        throw GridError("line " + std::to_string(entry.first.Mark().line + 1) +
                        ": a key must be text");
      }
      std::string key = entry.first.Scalar();
      std::replace_if(key.begin(), key.end(), is_control, '?');
      if (!keys_.emplace(key, entry.second).second) {
        throw GridError("this key is there twice: remove one", "/" + key);
      }
    }
  }

  bool has(const std::string& key) const { return keys_.contains(key); }

  std::string text(const std::string& key) {
    const YAML::Node value = take(key);
    const bool is_text = value.IsScalar() && !value.Scalar().empty() &&
                         std::none_of(value.Scalar().begin(), value.Scalar().end(), is_control);
    if (!is_text) throw GridError("must be text", "/" + key);
    return value.Scalar();
  }

  double number(const std::string& key, double low, double high) {
    return to_number(take(key), "/" + key, low, high);
  }

  /// A boolean of YAML 1.1, or 0 or 1, as map_saver writes it.
  bool flag(const std::string& key) {
    const YAML::Node value = take(key);
    if (value.IsScalar() && value.Scalar() == "0") return false;
    if (value.IsScalar() && value.Scalar() == "1") return true;
    bool flag = false;
    if (!YAML::convert<bool>::decode(value, flag)) {
      throw GridError("must be 0 or 1, or a boolean", "/" + key);
    }
    return flag;
  }

  core::Pose2 pose(const std::string& key) {
    const YAML::Node value = take(key);
    if (!value.IsSequence() || value.size() != 3) {
      throw GridError("must be a list of x, y and yaw", "/" + key);
    }
    const auto item = [&](std::size_t i, double limit) {
      return to_number(value[i], "/" + key + "/" + std::to_string(i), -limit, limit);
    };
    const double x_m = item(0, kMaxOffset_m);
    const double y_m = item(1, kMaxOffset_m);
    return {x_m, y_m, core::normalize_angle(item(2, kMaxYaw_rad))};
  }

  std::vector<std::string> rest() const {
    std::vector<std::string> names;
    for (const auto& [key, value] : keys_) names.push_back(key);
    return names;
  }

 private:
  YAML::Node take(const std::string& key) {
    const auto place = keys_.find(key);
    if (place == keys_.end()) throw GridError("is missing: add it", "/" + key);
    const YAML::Node value = place->second;
    keys_.erase(place);
    return value;
  }

  static double to_number(const YAML::Node& value, const std::string& pointer, double low,
                          double high) {
    double number = 0;
    if (!YAML::convert<double>::decode(value, number) || !std::isfinite(number)) {
      throw GridError("must be a number", pointer);
    }
    if (number < low || number > high) {
      char range[80];
      std::snprintf(range, sizeof range, "must be from %g to %g", low, high);
      throw GridError(range, pointer);
    }
    return number;
  }

  std::map<std::string, YAML::Node> keys_;
};

ShadeMode to_mode(const std::string& name) {
  if (name == "trinary") return ShadeMode::kTrinary;
  if (name == "scale") return ShadeMode::kScale;
  if (name == "raw") return ShadeMode::kRaw;
  throw GridError("must be trinary, scale or raw", "/mode");
}

MapServerYaml read(KeyReader keys) {
  MapServerYaml yaml;
  yaml.image = keys.text("image");
  yaml.resolution_m = keys.number("resolution", 1e-3, 10);
  yaml.T_map_picture = keys.pose("origin");
  yaml.negate = keys.flag("negate");
  yaml.occupied_threshold = keys.number("occupied_thresh", 0, 1);
  yaml.free_threshold = keys.number("free_thresh", 0, 1);
  if (yaml.free_threshold >= yaml.occupied_threshold) {
    throw GridError("must be below occupied_thresh", "/free_thresh");
  }
  if (keys.has("mode")) yaml.mode = to_mode(keys.text("mode"));
  yaml.unknown_keys = keys.rest();
  return yaml;
}

}  // namespace

bool has_yaml() { return true; }

MapServerYaml parse_map_server_yaml(std::string_view text) {
  try {
    return read(KeyReader(YAML::Load(std::string(text))));
  } catch (const YAML::Exception& error) {
    const bool has_line = !error.mark.is_null();
    throw GridError((has_line ? "line " + std::to_string(error.mark.line + 1) + ": " : "") +
                    "is no YAML (a picture is named by its yaml): " + error.msg);
  }
}

}  // namespace cornerd::gridmap

#else

namespace cornerd::gridmap {

bool has_yaml() { return false; }

MapServerYaml parse_map_server_yaml(std::string_view) {
  throw GridError(
      "this program was built without libyaml-cpp and reads no YAML: import the map on a PC, and "
      "copy the result");
}

}  // namespace cornerd::gridmap

#endif
