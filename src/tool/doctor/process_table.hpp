// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tool/doctor/machine.hpp"

namespace cornerd::tool {

struct Process {
  int pid = 0;
  std::string name;
};

struct PortHolders {
  std::vector<Process> processes;
  /// False: the open files of other users' processes could not be read.
  bool complete = true;
};

std::optional<Process> find_process(const Machine& machine, std::string_view name);

/// Processes that have the device open or locked. `device`: its own path, not a link to it.
PortHolders holders_of(const Machine& machine, const std::filesystem::path& device);

/// The process of a line of /proc/locks; nullopt if the lock is on another file.
std::optional<int> lock_owner(std::string_view line, const FileFacts& file);

}  // namespace cornerd::tool
