// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>

#include "tool/doctor/machine.hpp"

namespace cornerd::tool {

/// Are the package's rules, or a copy of them, where udev reads rules?
bool has_udev_rules(const Machine& machine);

/// What udev noted of a port ("ttyUSB0") when it was plugged in, a line each: "E:ID_MODEL=CP2102".
/// nullopt: nothing.
std::optional<std::string> udev_notes(const Machine& machine, const std::string& port);

}  // namespace cornerd::tool
