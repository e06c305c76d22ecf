// SPDX-License-Identifier: MIT
#include "tool/doctor/checks.hpp"
#include "tool/doctor/service_unit.hpp"

namespace cornerd::tool {

namespace {

std::vector<std::string> remedies_for(const Patient& patient, const Account& who, bool is_service,
                                      const FileFacts& port, const std::string& name) {
  const bool group_may = (port.mode >> 3 & 06U) == 06U;
  const std::string group = group_name(patient.machine, port.gid);
  if (!group_may || port.gid == 0) {
    return {
        "give it to a group by the udev rules of the package (61-cornerd.rules); until the next "
        "plug: sudo chgrp dialout " +
        name + " && sudo chmod 660 " + name};
  }
  if (is_service)
    return {"sudo usermod -aG " + group + " cornerd && sudo systemctl restart cornerd"};
  const auto account = find_account(patient.machine, who.name);
  if (account && account->gids.contains(port.gid)) {
    return {who.name + " is in " + group +
            ", but this session began before that: log out and in again"};
  }
  return {"sudo usermod -aG " + group + " " + who.name + ", then log out and in again"};
}

}  // namespace

Finding check_port_rights(const Patient& patient, const FileFacts& port) {
  const std::string name = port_of(patient).string();
  const std::optional<Account> service = service_account(patient.machine);
  const Account& who = service ? *service : patient.caller;
  const std::string user = service ? "the service's user cornerd" : who.name;
  const std::string rights = " " + name + " (" + describe_rights(patient.machine, port) + ")";
  if (may_read_and_write(who, port)) {
    return {Verdict::kGood, "rights", user + " may open" + rights};
  }
  return {Verdict::kWrong, "rights", user + " must not open" + rights,
          remedies_for(patient, who, service.has_value(), port, name)};
}

std::vector<Finding> check_rights(const Patient& patient) {
  if (patient.config.lidar.driver == settings::DriverKind::kReplay) return {};
  const auto port = patient.machine.facts(patient.config.lidar.device);
  if (!port || !has_port(patient)) return {};
  std::vector<Finding> findings = {check_port_rights(patient, *port)};
  const std::filesystem::path name = port_of(patient);
  if (service_account(patient.machine) && !service_unit_allows(patient.machine, name)) {
    findings.push_back({Verdict::kWrong,
                        "rights",
                        "the service's unit denies " + name.string() +
                            ": its DeviceAllow= has no " + port_kind(name),
                        {"sudo systemctl edit cornerd, and write there: [Service], and below it "
                         "DeviceAllow=char-" +
                             port_kind(name) + " rw",
                         "then: sudo systemctl restart cornerd"}});
  }
  return findings;
}

}  // namespace cornerd::tool
