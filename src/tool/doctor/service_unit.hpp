// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "tool/doctor/machine.hpp"

namespace cornerd::tool {

/// Is cornerd.service installed?
bool has_service_unit(const Machine& machine);

/// Values of a key in cornerd.service and its drop-ins, in systemd's order; an empty value clears
/// the earlier ones.
std::vector<std::string> service_unit_values(const Machine& machine, std::string_view key);

/// True if the unit allows the port, or if there is no unit. `port`: its own path, not a link.
bool service_unit_allows(const Machine& machine, const std::filesystem::path& port);

/// The port's kind as in /proc/devices and DeviceAllow=: "ttymxc" for "/dev/ttymxc3".
std::string port_kind(const std::filesystem::path& port);

}  // namespace cornerd::tool
