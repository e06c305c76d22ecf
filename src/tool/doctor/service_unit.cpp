// SPDX-License-Identifier: MIT
#include "tool/doctor/service_unit.hpp"

#include <fnmatch.h>

#include <algorithm>
#include <array>
#include <map>
#include <sstream>

namespace cornerd::tool {

namespace {

namespace fs = std::filesystem;

/// systemd's folders; the later ones win.
constexpr std::array kUnitFolders = {"/lib/systemd/system", "/usr/lib/systemd/system",
                                     "/run/systemd/system", "/etc/systemd/system"};
constexpr const char* kUnit = "cornerd.service";

/// The unit, then its drop-ins by name.
std::vector<fs::path> unit_files(const Machine& machine) {
  fs::path unit;
  std::map<std::string, fs::path> drop_ins;
  for (const fs::path folder : kUnitFolders) {
    if (machine.exists(folder / kUnit)) unit = folder / kUnit;
    const fs::path beside = folder / (std::string(kUnit) + ".d");
    for (const std::string& name : machine.list(beside)) {
      if (name.ends_with(".conf")) drop_ins[name] = beside / name;
    }
  }
  if (unit.empty()) return {};
  std::vector<fs::path> files = {unit};
  files.reserve(1 + drop_ins.size());
  for (const auto& [name, file] : drop_ins) files.push_back(file);
  return files;
}

std::string trimmed(const std::string& text) {
  const std::size_t begin = text.find_first_not_of(" \t\r");
  if (begin == std::string::npos) return {};
  return text.substr(begin, text.find_last_not_of(" \t\r") + 1 - begin);
}

}  // namespace

bool has_service_unit(const Machine& machine) { return !unit_files(machine).empty(); }

std::vector<std::string> service_unit_values(const Machine& machine, std::string_view key) {
  std::vector<std::string> values;
  for (const fs::path& file : unit_files(machine)) {
    std::istringstream lines(machine.read(file).value_or(""));
    for (std::string line; std::getline(lines, line);) {
      const std::size_t equals = line.find('=');
      if (equals == std::string::npos || trimmed(line.substr(0, equals)) != key) continue;
      const std::string value = trimmed(line.substr(equals + 1));
      if (value.empty()) {
        values.clear();
      } else {
        values.push_back(value);
      }
    }
  }
  return values;
}

std::string port_kind(const fs::path& port) {
  std::string kind = port.filename().string();
  kind.erase(kind.find_last_not_of("0123456789") + 1);
  return kind;
}

bool service_unit_allows(const Machine& machine, const fs::path& port) {
  // Every policy has the pseudo-terminals.
  if (port.native().starts_with("/dev/pts/")) return true;
  const auto policies = service_unit_values(machine, "DevicePolicy");
  const auto allowed = service_unit_values(machine, "DeviceAllow");
  const bool is_open = policies.empty() || policies.back() == "auto";
  if (is_open && allowed.empty()) return true;
  return std::any_of(allowed.begin(), allowed.end(), [&](const std::string& value) {
    const auto words = split_words(value, " \t");
    const std::string_view access = words.size() > 1 ? words[1] : "rwm";
    if (access.find('r') == std::string_view::npos || access.find('w') == std::string_view::npos)
      return false;
    if (words[0].starts_with("/")) return machine.resolve(words[0]) == port;
    const std::string pattern(words[0]);
    return ::fnmatch(pattern.c_str(), ("char-" + port_kind(port)).c_str(), 0) == 0;
  });
}

}  // namespace cornerd::tool
