// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/geometry/pose2.hpp"
#include "drivers/make_driver.hpp"
#include "message/request.hpp"
#include "settings/config.hpp"

namespace cornerd::tool {

class Command;

/// --config, --map and --set of the commands that need settings.
class SettingsOptions {
 public:
  /// `fallback`: the config without the option.
  void add_config(Command& command, std::string_view fallback = "every key has its default");
  void add_map(Command& command);

  /// The config with the overrides of the command line. Without --config: defaults. Throws
  /// settings::SettingsError; UsageError if a map is needed and none is named.
  settings::Config resolve(bool needs_map) const;

  /// Without --config: the config of the daemon that runs, if it is the only one, or that of the
  /// service, if it is readable.
  void use_daemons_config();
  /// The config after use_daemons_config(), for a command that needs the daemon's sockets alone.
  settings::Config resolve_for_daemon() const {
    SettingsOptions options = *this;
    options.use_daemons_config();
    return options.resolve(/*needs_map=*/false);
  }
  /// As resolve(true); without --config and --map as resolve_for_daemon(), which is said.
  settings::Config resolve_with_map();
  const std::filesystem::path& config_file() const { return config_; }
  /// The values of --set, in the format of settings::parse_config.
  const std::vector<std::string>& set() const { return set_; }

  /// Adds the override "/json/pointer=value"; --set takes precedence.
  void add_override(const std::string& text) { overrides_.push_back(text); }

 private:
  std::filesystem::path config_;
  std::filesystem::path map_;
  std::vector<std::string> overrides_;
  std::vector<std::string> set_;
};

/// After use_daemons_config(), for add_config().
inline constexpr std::string_view kDaemonsConfig =
    "that of the daemon that runs, else /etc/cornerd/cornerd.json";

/// The config of the only cornerd that runs with --config; empty where there is none or several.
/// `processes`: "/proc", which tests replace.
std::filesystem::path running_config(const std::filesystem::path& processes);

/// --wire standard|express|...|auto, for bytes that begin without a response descriptor.
void add_wire_option(Command& command, std::string& wire);
struct NamedWire {
  std::string_view name;
  drivers::RecordedWire wire;
};
/// All that --wire takes but "auto".
std::span<const NamedWire> known_wires();
/// Neither driver nor format for "auto". The option has checked the name.
drivers::RecordedWire parse_wire(const std::string& name);

/// Options of a command that measures a config key in a known map.
struct CalibrationOptions {
  SettingsOptions settings;
  std::string wire = "auto";
  std::filesystem::path output;

  /// --config, --set, --map, --wire, and -o for the value of `key`.
  void add(Command& command, const std::string& key);
};

/// "POSE,SCAN" as a set. Throws UsageError.
message::ClassSet parse_classes(const std::vector<std::string>& names);

/// "x,y,theta" in metres and radians. Throws UsageError.
core::Pose2 parse_pose(const std::string& text);

/// "x,y x,y ..." in metres. Throws UsageError.
std::vector<core::Vec2> parse_points(const std::string& text);

}  // namespace cornerd::tool
