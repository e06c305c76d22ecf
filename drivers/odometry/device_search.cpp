// SPDX-License-Identifier: MIT
#include "drivers/odometry/device_search.hpp"

#include <algorithm>
#include <system_error>
#include <vector>

#include "drivers/odometry/attribute.hpp"

namespace cornerd::drivers {
namespace {

/// In the order of their names, so that the same tree gives the same answer.
std::vector<std::filesystem::path> folders_in(const std::filesystem::path& devices) {
  std::vector<std::filesystem::path> folders;
  std::error_code error;
  for (std::filesystem::directory_iterator entry(devices, error), end; !error && entry != end;
       entry.increment(error)) {
    folders.push_back(entry->path());
  }
  std::sort(folders.begin(), folders.end());
  return folders;
}

}  // namespace

FoundDevice find_device(const std::filesystem::path& devices, std::string_view name) {
  FoundDevice found;
  std::string others;
  bool is_only_one = true;
  for (const std::filesystem::path& folder : folders_in(devices)) {
    const auto its_name = read_attribute(folder / "name");
    if (!its_name) continue;
    if (*its_name == name || read_attribute(folder / "label") == name) {
      is_only_one = found.folder.empty();
      found.folder = folder;
    } else {
      others.append(others.empty() ? "" : ", ").append(*its_name);
    }
  }
  if (!is_only_one) {
    found.folder.clear();
    found.problem.append("several in ")
        .append(devices.string())
        .append(" are called ")
        .append(name);
  } else if (found.folder.empty()) {
    found.problem.append("none in ").append(devices.string()).append(" is called ").append(name);
    if (!others.empty()) found.problem.append("; there are ").append(others);
  }
  return found;
}

}  // namespace cornerd::drivers
