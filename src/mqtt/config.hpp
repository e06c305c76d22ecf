// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "mqtt/broker.hpp"
#include "settings/config.hpp"

namespace cornerd::mqtt {

/// Versions of VDA 5050, "interface for the communication between automated guided vehicles and a
/// master control".
enum class VdaVersion : std::uint8_t { kV20, kV21, kV30 };

enum class Kinematics : std::uint8_t { kDifferential, kOmnidirectional, kThreeWheel };

/// What the factsheet says of the vehicle: the bridge cannot know it.
struct VehicleConfig {
  std::string series = "cornerd";
  std::string_view vehicle_class = "CARRIER";
  Kinematics kinematics = Kinematics::kDifferential;
  double max_speed_m_s = 0.5;
  double max_acceleration_m_s2 = 0.5;
  double width_m = 0.3;
  double length_m = 0.3;
  double height_m = 0.3;
  double max_load_kg = 0;
};

struct BridgeConfig {
  BrokerConfig broker;
  std::string manufacturer = "cornerd";
  std::string serial;  ///< default: this machine's name
  VdaVersion vda5050 = VdaVersion::kV21;
  double visualization_hz = 5;
  double max_deviation_m = 0.3;  ///< of a pose that counts as initialized
  double max_age_s = 3;          ///< of the last scan that named a place
  VehicleConfig vehicle;
  std::string site = "default";  ///< of the fleet's topics
  std::string map;               ///< which map of the site this robot follows; empty: none
  std::filesystem::path map_folder = "/etc/cornerd/fleet";
  std::string home_assistant;  ///< its discovery prefix; empty: none
  settings::SocketConfig socket;
};

/// Of the file, with `//` comments. Throws SettingsError with JSON pointer and reason. The password
/// file is read by read_password().
BridgeConfig parse_bridge_config(std::string_view text, const std::filesystem::path& file);

/// Reads and parses the file, reads the password's file, and looks whether those of TLS can be
/// read. Throws SettingsError.
BridgeConfig load_bridge_config(const std::filesystem::path& file);

/// "broker.example", "10.0.0.7:1884" or "[::1]:1883". Throws std::invalid_argument.
BrokerConfig broker_at(const std::string& host_and_port);

/// Broker and site of a fleet, as the options --broker, --broker-config and --site give them.
struct FleetOptions {
  std::string broker;
  std::filesystem::path config;  ///< of cornerd-mqtt
  std::string site;              ///< empty: the config's, else the default

  bool is_given() const { return !broker.empty() || !config.empty(); }
  /// Throws std::invalid_argument where neither or both are given, SettingsError for the config.
  BrokerConfig broker_config() const;
  /// Throws std::invalid_argument where it is no level of a topic, SettingsError for the config.
  std::string site_name() const;
};

/// A level of a topic: neither empty nor with '/', '+', '#', or a control character.
bool is_topic_level(std::string_view text);

}  // namespace cornerd::mqtt
