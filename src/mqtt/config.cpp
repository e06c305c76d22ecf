// SPDX-License-Identifier: MIT
#include "mqtt/config.hpp"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "settings/document.hpp"
#include "settings/object_reader.hpp"

namespace cornerd::mqtt {

namespace {

using settings::Choice;
using settings::ObjectReader;

constexpr std::size_t kMaxConfigBytes = 64 * 1024;
constexpr std::size_t kMaxTextBytes = 128;
constexpr Choice<VdaVersion> kVersions[] = {
    {"2.0", VdaVersion::kV20}, {"2.1", VdaVersion::kV21}, {"3.0", VdaVersion::kV30}};
constexpr Choice<std::string_view> kClasses[] = {{"FORKLIFT", "FORKLIFT"},
                                                 {"CONVEYOR", "CONVEYOR"},
                                                 {"TUGGER", "TUGGER"},
                                                 {"CARRIER", "CARRIER"}};
constexpr Choice<Kinematics> kKinematics[] = {{"DIFF", Kinematics::kDifferential},
                                              {"OMNI", Kinematics::kOmnidirectional},
                                              {"THREEWHEEL", Kinematics::kThreeWheel}};
constexpr Choice<bool> kProtocols[] = {{"5", true}, {"3.1.1", false}};

void read_level(ObjectReader& object, std::string_view key, std::string& level) {
  if (object.text(key, level, kMaxTextBytes) && !is_topic_level(level)) {
    object.fail(key, "must not have '/', '+', '#' or control characters: it is part of a topic");
  }
}

void read_tls(ObjectReader tls, BrokerConfig& broker) {
  broker.is_tls = true;
  broker.ca = "/etc/ssl/certs";
  tls.path("ca", broker.ca);
  const bool has_certificate = tls.path("certificate", broker.certificate);
  if (tls.path("key", broker.key) != has_certificate) {
    tls.fail(has_certificate ? "key" : "certificate", "certificate and key belong together");
  }
  tls.finish();
}

void read_broker(ObjectReader object, BrokerConfig& broker, std::filesystem::path& password_file) {
  object.text("host", broker.host, 255);
  if (object.find("tls") != nullptr) {
    broker.port = 8883;
    read_tls(object.object("tls"), broker);
  }
  object.integer("port", broker.port, std::uint16_t{1}, std::uint16_t{65535});
  const bool has_user = object.text("user", broker.user, kMaxTextBytes);
  if (object.path("password_file", password_file) && !has_user) {
    object.fail("user", "a password needs a user");
  }
  object.choice("protocol", broker.is_v5, kProtocols);
  object.finish();
}

/// VDA 5050 3.0, section 6.1: of a serial number A-Z, a-z, 0-9, '_', '.', ':' and '-'.
bool is_serial(std::string_view text) {
  return !text.empty() && std::all_of(text.begin(), text.end(), [](unsigned char c) {
    return std::isalnum(c) != 0 ||
           std::string_view("_.:-").find(static_cast<char>(c)) != std::string_view::npos;
  });
}

std::string own_name() {
  std::array<char, 256> name{};
  if (::gethostname(name.data(), name.size() - 1) != 0) return "robot";
  return is_serial(name.data()) ? name.data() : "robot";
}

void read_robot(ObjectReader object, BridgeConfig& config) {
  read_level(object, "manufacturer", config.manufacturer);
  if (object.text("serial", config.serial, kMaxTextBytes) && !is_serial(config.serial)) {
    object.fail("serial", "must have letters, digits, '_', '.', ':' and '-' only");
  }
  object.finish();
}

void read_vehicle(ObjectReader object, VehicleConfig& vehicle) {
  object.text("series", vehicle.series, kMaxTextBytes);
  object.choice("class", vehicle.vehicle_class, kClasses);
  object.choice("kinematics", vehicle.kinematics, kKinematics);
  object.number("max_speed", vehicle.max_speed_m_s, {0, 100});
  object.number("max_acceleration", vehicle.max_acceleration_m_s2, {0, 100});
  object.number("width", vehicle.width_m, {0, 100});
  object.number("length", vehicle.length_m, {0, 100});
  object.number("height", vehicle.height_m, {0, 100});
  object.number("max_load", vehicle.max_load_kg, {0, 1e6});
  object.finish();
}

void read_site(ObjectReader object, BridgeConfig& config) {
  read_level(object, "name", config.site);
  read_level(object, "map", config.map);
  object.path("map_folder", config.map_folder);
  object.finish();
}

BridgeConfig parse(std::string_view text, const std::filesystem::path& file,
                   std::filesystem::path& password_file) {
  const settings::DocumentContext context{.file = file, .folder = file.parent_path()};
  const settings::Json document = settings::parse_document(text, file);
  ObjectReader root(context, document, "");
  BridgeConfig config;
  config.serial = own_name();
  read_broker(root.object("broker"), config.broker, password_file);
  read_robot(root.object("robot"), config);
  root.choice("vda5050", config.vda5050, kVersions);
  root.number("visualization_hz", config.visualization_hz, {0, 10});
  root.number("max_deviation", config.max_deviation_m, {0.001, 100});
  root.number("max_age", config.max_age_s, {0, 3600});
  read_vehicle(root.object("vehicle"), config.vehicle);
  read_site(root.object("site"), config);
  read_level(root, "home_assistant", config.home_assistant);
  ObjectReader socket = root.object("socket");
  socket.path("pose", config.socket.pose);
  socket.path("control", config.socket.control);
  socket.finish();
  root.finish();
  // The broker ends the connection of an older client with the same id.
  config.broker.client_id = "cornerd-" + config.manufacturer + "-" + config.serial;
  return config;
}

/// libmosquitto does not say which file it is that it cannot read.
void check_tls_files(const BrokerConfig& broker, const std::filesystem::path& file) {
  if (!broker.is_tls) return;
  const std::pair<const char*, const std::filesystem::path*> files[] = {
      {"ca", &broker.ca}, {"certificate", &broker.certificate}, {"key", &broker.key}};
  for (const auto& [key, path] : files) {
    if (path->empty() || ::access(path->c_str(), R_OK) == 0) continue;
    throw settings::SettingsError(
        file.string(), std::string("/broker/tls/") + key,
        path->string() + ": cannot be read: " + std::generic_category().message(errno));
  }
}

}  // namespace

bool is_topic_level(std::string_view text) {
  return !text.empty() && std::none_of(text.begin(), text.end(), [](unsigned char c) {
    return c < 0x20 || c == 0x7f || c == '/' || c == '+' || c == '#';
  });
}

BrokerConfig broker_at(const std::string& host_and_port) {
  BrokerConfig broker;
  broker.host = host_and_port;
  const std::size_t bracket = host_and_port.find(']');
  const std::size_t colon = host_and_port.rfind(':');
  // Without brackets an address of IPv6 has no port.
  const bool is_bare_ipv6 = bracket == std::string::npos && host_and_port.find(':') != colon;
  if (colon != std::string::npos && !is_bare_ipv6 &&
      (bracket == std::string::npos || colon > bracket)) {
    const char* const begin = host_and_port.data() + colon + 1;
    const char* const end = host_and_port.data() + host_and_port.size();
    const auto [parsed_to, error] = std::from_chars(begin, end, broker.port);
    if (error != std::errc() || parsed_to != end || broker.port == 0) {
      throw std::invalid_argument("the port must be a number from 1 to 65535");
    }
    broker.host.resize(colon);
  }
  if (broker.host.starts_with('[') && broker.host.ends_with(']')) {
    broker.host = broker.host.substr(1, broker.host.size() - 2);
  }
  if (broker.host.empty()) throw std::invalid_argument("a host is needed");
  return broker;
}

BrokerConfig FleetOptions::broker_config() const {
  if (broker.empty() == config.empty()) {
    throw std::invalid_argument("one of --broker HOST[:PORT] and --broker-config FILE is needed");
  }
  if (broker.empty()) {
    BrokerConfig of_config = load_bridge_config(config).broker;
    of_config.client_id.clear();  // the robot's own
    return of_config;
  }
  try {
    return broker_at(broker);
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(std::string("--broker: ") + error.what());
  }
}

std::string FleetOptions::site_name() const {
  if (site.empty()) return config.empty() ? BridgeConfig().site : load_bridge_config(config).site;
  if (is_topic_level(site)) return site;
  throw std::invalid_argument("--site must not have '/', '+' or '#'");
}

BridgeConfig parse_bridge_config(std::string_view text, const std::filesystem::path& file) {
  std::filesystem::path password_file;
  return parse(text, file, password_file);
}

BridgeConfig load_bridge_config(const std::filesystem::path& file) {
  std::filesystem::path password_file;
  BridgeConfig config = parse(settings::read_file(file, kMaxConfigBytes), file, password_file);
  check_tls_files(config.broker, file);
  if (!password_file.empty()) {
    config.broker.password = settings::read_file(password_file, kMaxTextBytes);
    config.broker.password.erase(
        std::min(config.broker.password.find_first_of("\r\n"), config.broker.password.size()));
  }
  return config;
}

}  // namespace cornerd::mqtt
