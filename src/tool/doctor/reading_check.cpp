// SPDX-License-Identifier: MIT
#include <sys/stat.h>

#include <algorithm>
#include <array>

#include "tool/doctor/checks.hpp"
#include "tool/doctor/process_table.hpp"
#include "tool/doctor/service_unit.hpp"

namespace cornerd::tool {

namespace {

namespace fs = std::filesystem;

constexpr mode_t kMayRead = 04;
constexpr mode_t kMaySearch = 01;

bool is_within(const fs::path& file, const fs::path& folder) {
  return std::mismatch(folder.begin(), folder.end(), file.begin(), file.end()).first ==
         folder.end();
}

/// A folder that the unit hides from the service, and the key that does so.
struct HiddenFolder {
  std::string key;
  fs::path folder;
};

std::vector<HiddenFolder> hidden_folders(const Machine& machine) {
  // Bound paths may be visible again.
  if (!service_unit_values(machine, "BindPaths").empty() ||
      !service_unit_values(machine, "BindReadOnlyPaths").empty()) {
    return {};
  }
  const auto is_on = [&](const char* key) {
    constexpr std::array<std::string_view, 5> kOn = {"yes", "true", "on", "1", "tmpfs"};
    const auto values = service_unit_values(machine, key);
    return !values.empty() && std::find(kOn.begin(), kOn.end(), values.back()) != kOn.end();
  };
  std::vector<HiddenFolder> folders;
  const auto add = [&](const char* key, const auto&... names) {
    if (is_on(key)) (folders.push_back({std::string(key) + "=yes", names}), ...);
  };
  add("ProtectHome", "/home", "/root", "/run/user");
  add("PrivateTmp", "/tmp", "/var/tmp");
  return folders;
}

std::vector<std::string> remedies_by_moving(const Patient& patient, const std::string& subject,
                                            const fs::path& file) {
  std::vector<std::string> remedies = {"sudo install -m 644 " + file.string() + " /etc/cornerd/"};
  const std::string copy = (fs::path("/etc/cornerd") / file.filename()).string();
  if (subject == "config") {
    if (copy != "/etc/cornerd/cornerd.json") {
      remedies.emplace_back("and name it cornerd.json there, which the service reads");
    }
  } else {
    const std::string key = subject == "map" ? "\"map\": \"" : "\"lidar\": { \"file\": \"";
    remedies.push_back("and, in " + patient.config_name + ": " + key + copy +
                       (subject == "map" ? "\"" : "\" }"));
  }
  return remedies;
}

/// Findings if the service cannot read a file.
std::vector<Finding> check_file_access(const Patient& patient, const Account& service,
                                       const std::string& subject, const fs::path& named) {
  const Machine& machine = patient.machine;
  const fs::path file = fs::absolute(named).lexically_normal();
  if (!machine.exists(file)) return {};  // reported by other checks
  const std::vector<fs::path> steps = machine.steps(file);
  for (const HiddenFolder& hidden : hidden_folders(machine)) {
    const bool is_hidden = std::any_of(steps.begin(), steps.end(), [&](const fs::path& step) {
      return is_within(step, hidden.folder) || is_within(step, machine.resolve(hidden.folder));
    });
    if (!is_hidden) continue;
    return {{Verdict::kWrong, subject,
             file.string() + ": the service cannot see " + hidden.folder.string() + " (" +
                 hidden.key + " in its unit)",
             remedies_by_moving(patient, subject, file)}};
  }
  for (const fs::path& step : steps) {
    const fs::path folder = machine.resolve(step.parent_path());
    const auto facts = machine.facts(folder);
    if (!facts || may_access(service, *facts, kMaySearch)) continue;
    auto remedies = remedies_by_moving(patient, subject, file);
    remedies.push_back("or open the folder: sudo chmod a+x " + folder.string());
    return {{Verdict::kWrong, subject,
             file.string() + ": the service's user cornerd must not enter " + folder.string() +
                 " (" + describe_rights(machine, *facts) + ")",
             remedies}};
  }
  const auto facts = machine.facts(file);
  if (!facts || may_access(service, *facts, kMayRead)) return {};
  return {{Verdict::kWrong,
           subject,
           file.string() + ": the service's user cornerd must not read it (" +
               describe_rights(machine, *facts) + ")",
           {"sudo chmod a+r " + file.string()}}};
}

/// True if a user other than the service's runs the daemon.
bool is_run_by_another(const Machine& machine, const Account& service) {
  const auto process = find_process(machine, "cornerd");
  const auto facts =
      process ? machine.facts("/proc/" + std::to_string(process->pid)) : std::nullopt;
  return facts && facts->uid != service.uid;
}

}  // namespace

std::vector<Finding> check_reading(const Patient& patient) {
  const std::optional<Account> service = service_account(patient.machine);
  if (!service || is_run_by_another(patient.machine, *service)) return {};
  std::vector<std::pair<std::string, fs::path>> files = {{"config", patient.config_file},
                                                         {"map", patient.config.map}};
  if (patient.config.lidar.driver == settings::DriverKind::kReplay) {
    files.emplace_back("recording", patient.config.lidar.file);
  }
  std::vector<Finding> findings;
  for (const auto& [subject, file] : files) {
    if (file.empty()) continue;
    for (Finding& finding : check_file_access(patient, *service, subject, file)) {
      findings.push_back(std::move(finding));
    }
  }
  if (findings.empty() && !patient.config_file.empty()) {
    findings.push_back(
        {Verdict::kGood, "reading", "the service's user cornerd may read what the settings name"});
  }
  return findings;
}

}  // namespace cornerd::tool
