// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "message/parsed_line.hpp"
#include "settings/config.hpp"
#include "tool/doctor/accounts.hpp"
#include "tool/doctor/machine.hpp"

namespace cornerd::tool {

/// What the daemon said while it was listened to.
struct DaemonView {
  int connect_errno = 0;                        ///< why nobody could be asked; 0: somebody answered
  std::string version;                          ///< empty: it said nothing at all
  std::optional<message::ParsedStatus> status;  ///< the newest
  /// Of readings of wheels and gyro; nullopt where it was not listened to for long enough.
  std::optional<double> odometry_hz;
  /// Poses by state, in the order of core::PoseState.
  std::array<std::uint64_t, 5> poses{};
};

/// All that is examined.
struct Patient {
  Machine machine;
  settings::Config config;
  std::filesystem::path config_file;       ///< empty where there is none
  std::string config_name = "the config";  ///< as advice calls it
  Account caller;                          ///< who asks; its groups are those of its session
  DaemonView daemon;
};

/// The account that the service runs under; nullopt where it is not installed.
std::optional<Account> service_account(const Machine& machine);

/// Where lidar.device leads to in the end.
std::filesystem::path port_of(const Patient& patient);

/// What is there in a serial port's place, "a folder"; empty: a serial port, as far as can be told
/// without opening it, which disturbs a lidar.
std::string other_than_port(const Machine& machine, const FileFacts& file);
/// There is something at lidar.device, and it is a serial port.
bool has_port(const Patient& patient);

}  // namespace cornerd::tool
