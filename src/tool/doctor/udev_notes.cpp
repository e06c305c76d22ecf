// SPDX-License-Identifier: MIT
#include "tool/doctor/udev_notes.hpp"

#include <algorithm>
#include <iterator>
#include <vector>

namespace cornerd::tool {

bool has_udev_rules(const Machine& machine) {
  constexpr const char* kFolders[] = {"/lib/udev/rules.d", "/usr/lib/udev/rules.d",
                                      "/etc/udev/rules.d"};
  return std::any_of(std::begin(kFolders), std::end(kFolders), [&](const char* folder) {
    const std::vector<std::string> names = machine.list(folder);
    return std::any_of(names.begin(), names.end(),
                       [](const std::string& name) { return name.ends_with("-cornerd.rules"); });
  });
}

std::optional<std::string> udev_notes(const Machine& machine, const std::string& port) {
  const std::string number = machine.read_line("/sys/class/tty/" + port + "/dev");
  return number.empty() ? std::nullopt : machine.read("/run/udev/data/c" + number);
}

}  // namespace cornerd::tool
