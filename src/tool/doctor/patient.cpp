// SPDX-License-Identifier: MIT
#include "tool/doctor/patient.hpp"

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

}  // namespace cornerd::tool
