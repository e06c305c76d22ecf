// SPDX-License-Identifier: MIT
// The checks of doctor, from the plug to the pose. A check that applies returns at least one
// finding; one that does not apply returns none.
#pragma once

#include <exception>
#include <string>
#include <vector>

#include "tool/doctor/finding.hpp"
#include "tool/doctor/patient.hpp"

namespace cornerd::tool {

/// Can the service's user read the config, and the map and recording that it names?
std::vector<Finding> check_reading(const Patient& patient);
/// Is there a serial port at lidar.device?
std::vector<Finding> check_port(const Patient& patient);
/// Can the daemon's user open the port?
std::vector<Finding> check_rights(const Patient& patient);
/// The same for a port with this owner, group and mode.
Finding check_port_rights(const Patient& patient, const FileFacts& port);
/// Which process has the port open, and is it a kernel console?
std::vector<Finding> check_holders(const Patient& patient);
/// Does another service claim the port: gpsd, ModemManager, brltty?
std::vector<Finding> check_claimers(const Patient& patient);
/// Are there signs of a weak supply, cable or hub?
std::vector<Finding> check_power(const Patient& patient);
/// Does the daemon run, and which states does it report?
std::vector<Finding> check_daemon(const Patient& patient);
/// Can the caller send requests to the daemon?
std::vector<Finding> check_control(const Patient& patient);
/// Does the daemon send poses, and are most of them fixes?
std::vector<Finding> check_poses(const Patient& patient);
/// Are most returns within lidar.max_range?
std::vector<Finding> check_range(const Patient& patient);
/// Are the residuals of the scans those of lidar.noise?
std::vector<Finding> check_residuals(const Patient& patient);

/// All of the above.
std::vector<Finding> examine(const Patient& patient);

/// The settings that could be read, and the findings about them.
struct SettingsCheck {
  settings::Config config;
  std::vector<Finding> findings;
  std::exception_ptr error;  ///< the first SettingsError; null if there is none
};

/// `file`: empty for the default of every key.
SettingsCheck check_settings(const std::filesystem::path& file,
                             const std::vector<std::string>& overrides);

}  // namespace cornerd::tool
