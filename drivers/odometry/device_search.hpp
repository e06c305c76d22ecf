// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace cornerd::drivers {

/// A device's folder, or why there is none.
struct FoundDevice {
  std::filesystem::path folder;  ///< empty: none
  std::string problem;           ///< for a person
};

/// The one device of a bus that bears this name, as its attribute `name` or `label` has it: the
/// numbers in the folders' own names follow the order in which drivers were loaded. `devices`: the
/// bus's folder of devices. Never throws but for want of memory.
FoundDevice find_device(const std::filesystem::path& devices, std::string_view name);

}  // namespace cornerd::drivers
