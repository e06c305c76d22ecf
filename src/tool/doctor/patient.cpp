// SPDX-License-Identifier: MIT
#include "tool/doctor/patient.hpp"

#include <sys/stat.h>

#include <array>
#include <iterator>

#include "tool/doctor/checks.hpp"

namespace cornerd::tool {

std::optional<Account> service_account(const Machine& machine) {
  std::optional<Account> account = find_account(machine, "cornerd");
  // The unit's SupplementaryGroups=.
  const std::optional<gid_t> dialout = find_group(machine, "dialout");
  if (account && dialout) account->gids.insert(*dialout);
  return account;
}

std::filesystem::path port_of(const Patient& patient) {
  return patient.machine.resolve(patient.config.lidar.device);
}

std::string other_than_port(const Machine& machine, const FileFacts& file) {
  // Pseudo-terminals, which sysfs does not have.
  constexpr unsigned kFirstPtyMajor = 136;
  constexpr unsigned kLastPtyMajor = 143;
  switch (file.mode & S_IFMT) {
    case S_IFCHR:
      break;
    case S_IFDIR:
      return "a folder";
    case S_IFIFO:
      return "a named pipe";
    case S_IFSOCK:
      return "a socket";
    case S_IFREG:
      return "an ordinary file";
    default:
      return "another kind of device";
  }
  if (file.own_major >= kFirstPtyMajor && file.own_major <= kLastPtyMajor) return {};
  const std::filesystem::path subsystem =
      machine.read_link("/sys/dev/char/" + std::to_string(file.own_major) + ":" +
                        std::to_string(file.own_minor) + "/subsystem");
  if (subsystem.empty() || subsystem.filename() == "tty") return {};
  return "a device of the kind \"" + subsystem.filename().string() + "\"";
}

bool has_port(const Patient& patient) {
  const std::optional<FileFacts> file = patient.machine.facts(patient.config.lidar.device);
  return file && other_than_port(patient.machine, *file).empty();
}

std::vector<Finding> examine(const Patient& patient) {
  constexpr std::array kChecks = {check_reading,  check_port,  check_rights,   check_holders,
                                  check_claimers, check_power, check_daemon,   check_control,
                                  check_poses,    check_range, check_residuals};
  std::vector<Finding> findings;
  for (const auto check : kChecks) {
    std::vector<Finding> found = check(patient);
    std::move(found.begin(), found.end(), std::back_inserter(findings));
  }
  return findings;
}

}  // namespace cornerd::tool
