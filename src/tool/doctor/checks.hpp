// SPDX-License-Identifier: MIT
// What doctor looks at, in the order from the plug to the pose. Each check says at least one thing
// where it applies, and nothing where it does not: a recording in the lidar's place has no port.
#pragma once

#include <exception>
#include <string>
#include <vector>

#include "tool/doctor/finding.hpp"
#include "tool/doctor/patient.hpp"

namespace cornerd::tool {

/// May the service's user read what the settings are in and what they name, wherever it lies?
std::vector<Finding> check_reading(const Patient& patient);
/// Is there a port where the settings say, and if not, where is it?
std::vector<Finding> check_port(const Patient& patient);
/// May whoever runs the daemon open it?
std::vector<Finding> check_rights(const Patient& patient);
/// The same of a port with such an owner, group and mode.
Finding check_port_rights(const Patient& patient, const FileFacts& port);
/// Who has it open, and does the kernel talk on it?
std::vector<Finding> check_holders(const Patient& patient);
/// Is there anything that takes such ports for itself: gpsd, ModemManager, brltty?
std::vector<Finding> check_claimers(const Patient& patient);
/// Did supply, cable or hub fail, or are they about to?
std::vector<Finding> check_power(const Patient& patient);
/// Does the daemon run, and how does it say that its lidar is?
std::vector<Finding> check_daemon(const Patient& patient);
/// May whoever asks send requests to the daemon?
std::vector<Finding> check_control(const Patient& patient);
/// Are there poses, and if they name no place, why?
std::vector<Finding> check_poses(const Patient& patient);

/// All of the above.
std::vector<Finding> examine(const Patient& patient);

/// Settings as far as they can be read, and what is wrong with them.
struct SettingsCheck {
  settings::Config config;
  std::vector<Finding> findings;
  std::exception_ptr error;  ///< the first SettingsError; null where all is well
};

/// `file`: empty where there is none and every key has its default.
SettingsCheck check_settings(const std::filesystem::path& file,
                             const std::vector<std::string>& overrides);

}  // namespace cornerd::tool
