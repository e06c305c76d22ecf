// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "tool/doctor/machine.hpp"

namespace cornerd::tool {

/// Is cornerd.service installed?
bool has_service_unit(const Machine& machine);

/// What cornerd.service and its drop-ins set a key to, in systemd's order; an empty value takes
/// back those before it.
std::vector<std::string> service_unit_values(const Machine& machine, std::string_view key);

/// Does the unit let the service have such a port? True where there is no unit. `port`: its own
/// path, not a link to it.
bool service_unit_allows(const Machine& machine, const std::filesystem::path& port);

/// As /proc/devices and DeviceAllow= call the kind of a port: "ttymxc" of "/dev/ttymxc3".
std::string port_kind(const std::filesystem::path& port);

}  // namespace cornerd::tool
