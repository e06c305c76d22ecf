// SPDX-License-Identifier: MIT
#include "tool/command_line/shared_options.hpp"

#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <optional>
#include <sstream>
#include <string_view>

#include "message/field_reader.hpp"
#include "settings/document.hpp"
#include "settings/object_reader.hpp"
#include "tool/command_line/command.hpp"
#include "tool/command_line/failure.hpp"

namespace cornerd::tool {

namespace {

constexpr const char* kInstalledConfig = "/etc/cornerd/cornerd.json";

/// Exactly `count` finite numbers separated by commas; empty for any other text.
std::vector<double> parse_numbers(std::string_view text, std::size_t count) {
  std::vector<double> numbers;
  const char* at = text.data();
  const char* const end = at + text.size();
  while (numbers.size() < count) {
    double number = 0;
    const auto [next, error] = std::from_chars(at, end, number);
    if (error != std::errc() || !std::isfinite(number)) return {};
    numbers.push_back(number);
    if (numbers.size() == count) return next == end ? numbers : std::vector<double>{};
    if (next == end || *next != ',') return {};
    at = next + 1;
  }
  return {};
}

/// The words of a process's command line.
std::vector<std::string> words_of(const std::filesystem::path& process) {
  std::ifstream stream(process / "cmdline", std::ios::binary);
  std::vector<std::string> words;
  for (std::string word; std::getline(stream, word, '\0');) words.push_back(word);
  return words;
}

}  // namespace

std::filesystem::path running_config(const std::filesystem::path& processes) {
  std::filesystem::path found;
  std::error_code ended;
  for (const auto& process : std::filesystem::directory_iterator(processes, ended)) {
    const std::vector<std::string> words = words_of(process.path());
    if (words.empty() || std::filesystem::path(words.front()).filename() != "cornerd") continue;
    const auto option = std::find(words.begin(), words.end(), "--config");
    if (option == words.end() || option + 1 == words.end()) continue;
    const auto folder = std::filesystem::read_symlink(process.path() / "cwd", ended);
    const std::filesystem::path config = (folder / option[1]).lexically_normal();
    if (::access(config.c_str(), R_OK) != 0 || config == found) continue;
    if (!found.empty()) return {};
    found = config;
  }
  return found;
}

void SettingsOptions::add_config(Command& command, std::string_view fallback) {
  command.add_option("--config", config_, "config file; default: " + std::string(fallback))
      .type_name("FILE");
  command.add_option("--set", set_, "override a config value: /json/pointer=value")
      .type_name("/PTR=VALUE")
      .check([](const std::string& text) {
        return settings::is_override(text) ? std::string() : "must be /json/pointer=value";
      })
      .one_word();
}

void SettingsOptions::add_map(Command& command) {
  command.add_option("--map", map_, "map of the building; default: the map of the config")
      .type_name("FILE");
}

void SettingsOptions::use_daemons_config() {
  if (config_.empty()) config_ = running_config("/proc");
  if (config_.empty() && ::access(kInstalledConfig, R_OK) == 0) config_ = kInstalledConfig;
}

settings::Config SettingsOptions::resolve_with_map() {
  if (config_.empty() && map_.empty()) {
    use_daemons_config();
    if (!config_.empty()) std::fprintf(stderr, "cornerctl: config %s\n", config_.c_str());
  }
  return resolve(/*needs_map=*/true);
}

settings::Config SettingsOptions::resolve(bool needs_map) const {
  if (needs_map && config_.empty() && map_.empty()) {
    throw UsageError("no map: name one with --map FILE, or with the key map in --config FILE");
  }
  std::vector<std::string> overrides = overrides_;
  if (!map_.empty()) overrides.push_back("/map=" + settings::Json(map_.string()).dump());
  overrides.insert(overrides.end(), set_.begin(), set_.end());
  const std::string text =
      config_.empty() ? "{}" : settings::read_file(config_, settings::kMaxConfigBytes);
  settings::Config config = settings::parse_config(text, config_, overrides, needs_map);
  if (needs_map && config.chooses_map()) {
    throw settings::SettingsError(config_, "/map",
                                  "is \"auto\", which only the daemon takes: name one of \"maps\" "
                                  "with --set /map=NAME");
  }
  return config;
}

void add_wire_option(Command& command, std::string& wire) {
  std::vector<std::string> names;
  for (const NamedWire& known : known_wires()) names.emplace_back(known.name);
  names.emplace_back("auto");
  command.add_option("--wire", wire, "format of bytes that begin without a response descriptor")
      .choices(names)
      .capture_default_str();
}

std::span<const NamedWire> known_wires() {
  using rplidar::WireFormat;
  constexpr auto kRplidar = drivers::DriverKind::kRplidar;
  static const NamedWire kWires[] = {
      {"standard", {kRplidar, WireFormat::kStandard}},
      {"express", {kRplidar, WireFormat::kExpress}},
      {"ultra", {kRplidar, WireFormat::kUltra}},
      {"dense", {kRplidar, WireFormat::kDense}},
      {"ultra-dense", {kRplidar, WireFormat::kUltraDense}},
      {"hq", {kRplidar, WireFormat::kHq}},
      {"ld", {drivers::DriverKind::kLd}},
      {"ydlidar", {drivers::DriverKind::kYdlidar}},
  };
  return kWires;
}

drivers::RecordedWire parse_wire(const std::string& name) {
  for (const NamedWire& known : known_wires()) {
    if (known.name == name) return known.wire;
  }
  return {};
}

void CalibrationOptions::add(Command& command, const std::string& key) {
  settings.add_config(command);
  settings.add_map(command);
  command
      .add_option("-o,--output", output, "the key " + key + ", for a config; -: on standard output")
      .type_name("JSON");
  add_wire_option(command, wire);
}

message::ClassSet parse_classes(const std::vector<std::string>& names) {
  message::ClassSet classes;
  for (const std::string& name : names) {
    const std::optional<message::MessageClass> known = message::message_class_from(name);
    if (!known) {
      throw UsageError("--classes: '" + name +
                       "' is no message class; they are: " + message::class_names());
    }
    classes.insert(*known);
  }
  return classes;
}

core::Pose2 parse_pose(const std::string& text) {
  const std::vector<double> numbers = parse_numbers(text, 3);
  if (numbers.empty()) {
    throw UsageError("'" + text + "' is no pose: x,y,theta in metres and radians");
  }
  if (std::abs(numbers[2]) > message::kAngleLimitsRad.high) {
    throw UsageError("'" + text + "': theta is in radians, and 90 degrees are 1.5708");
  }
  return {numbers[0], numbers[1], core::normalize_angle(numbers[2])};
}

std::vector<core::Vec2> parse_points(const std::string& text) {
  std::vector<core::Vec2> points;
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    const std::vector<double> numbers = parse_numbers(word, 2);
    if (numbers.empty()) throw UsageError("'" + word + "' is no point: x,y in metres");
    points.emplace_back(numbers[0], numbers[1]);
  }
  return points;
}

}  // namespace cornerd::tool
