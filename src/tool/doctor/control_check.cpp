// SPDX-License-Identifier: MIT
#include "tool/doctor/checks.hpp"

namespace cornerd::tool {

std::vector<Finding> check_control(const Patient& patient) {
  const std::optional<gid_t> group = find_group(patient.machine, "cornerd");
  const Account& caller = patient.caller;
  if (!group || caller.uid == 0) return {};
  if (caller.gids.contains(*group)) {
    return {{Verdict::kGood, "control",
             caller.name + " is in the group cornerd and may send requests"}};
  }
  const std::optional<Account> account = find_account(patient.machine, caller.name);
  if (account && account->gids.contains(*group)) {
    return {{Verdict::kNote,
             "control",
             caller.name + " is in the group cornerd, this session is older than that",
             {"log out and in again"}}};
  }
  return {{Verdict::kNote,
           "control",
           caller.name + " may read poses, but send no requests (odometry, SET_POSE, RELOCALIZE)",
           {"sudo usermod -aG cornerd " + caller.name + ", then log out and in again"}}};
}

}  // namespace cornerd::tool
