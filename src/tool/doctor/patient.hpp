// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "message/parsed_line.hpp"
#include "settings/config.hpp"
#include "tool/doctor/accounts.hpp"
#include "tool/doctor/machine.hpp"

namespace cornerd::tool {

/// The daemon's messages during the probe.
struct DaemonView {
  int connect_errno = 0;                        ///< 0: connected
  std::string version;                          ///< empty: no message came
  std::optional<message::ParsedStatus> status;  ///< the newest
  /// Odometry readings a second; nullopt if the probe was too short.
  std::optional<double> odometry_hz;
  /// Poses by state, in the order of core::PoseState.
  std::array<std::uint64_t, 5> poses{};
  std::vector<double> rmse_m;         ///< of each scan that gave a pose
  std::vector<float> scan_returns_m;  ///< ranges of all scans
};

/// The input of all checks.
struct Patient {
  Machine machine;
  settings::Config config;
  std::filesystem::path config_file;       ///< empty where there is none
  std::string config_name = "the config";  ///< its name in remedies
  Account caller;                          ///< with the groups of its session
  DaemonView daemon;
};

/// The service's account; nullopt if the service is not installed.
std::optional<Account> service_account(const Machine& machine);

/// lidar.device with links followed.
std::filesystem::path port_of(const Patient& patient);

/// The file's type if it is no serial port ("a folder"), else empty. Does not open the port, which
/// would disturb the lidar.
std::string other_than_port(const Machine& machine, const FileFacts& file);
/// True if lidar.device exists and is a serial port.
bool has_port(const Patient& patient);

}  // namespace cornerd::tool
