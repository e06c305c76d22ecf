// SPDX-License-Identifier: MIT
#include <array>
#include <iterator>

#include "tool/doctor/checks.hpp"

namespace cornerd::tool {

std::vector<Finding> examine(const Patient& patient) {
  constexpr std::array kChecks = {check_reading, check_port,     check_rights,
                                  check_holders, check_claimers, check_power,
                                  check_daemon,  check_control,  check_poses};
  std::vector<Finding> findings;
  for (const auto check : kChecks) {
    std::vector<Finding> found = check(patient);
    std::move(found.begin(), found.end(), std::back_inserter(findings));
  }
  return findings;
}

}  // namespace cornerd::tool
