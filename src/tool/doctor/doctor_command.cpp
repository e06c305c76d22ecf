// SPDX-License-Identifier: MIT
// cornerctl doctor: finds faults between lidar and pose and names remedies.
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <iterator>
#include <memory>
#include <string>
#include <vector>

#include "tool/command_line/command.hpp"
#include "tool/command_line/failure.hpp"
#include "tool/command_line/output.hpp"
#include "tool/command_line/shared_options.hpp"
#include "tool/commands.hpp"
#include "tool/doctor/checks.hpp"
#include "tool/doctor/daemon_probe.hpp"

namespace cornerd::tool {

namespace {

/// Long enough for two STATUS.
constexpr std::chrono::milliseconds kProbeTime(2500);

/// The caller with the groups of its session, which may be older than /etc/group.
Account caller_account(const Machine& machine) {
  Account caller{std::to_string(::geteuid()), ::geteuid(), {::getegid()}};
  if (const auto known = find_account(machine, caller.uid)) caller.name = known->name;
  std::vector<gid_t> gids(static_cast<std::size_t>(std::max(0, ::getgroups(0, nullptr))));
  const int count = ::getgroups(static_cast<int>(gids.size()), gids.data());
  for (int i = 0; i < count; ++i) caller.gids.insert(gids[static_cast<std::size_t>(i)]);
  return caller;
}

void diagnose(SettingsOptions& options) {
  options.use_daemons_config();
  SettingsCheck settings = check_settings(options.config_file(), options.set());
  Patient patient;
  patient.config = settings.config;
  patient.config_file = options.config_file();
  if (!options.config_file().empty()) patient.config_name = options.config_file().string();
  patient.caller = caller_account(patient.machine);
  patient.daemon = probe_daemon(patient.config.socket.pose, kProbeTime);

  std::vector<Finding> findings = std::move(settings.findings);
  std::vector<Finding> found = examine(patient);
  std::move(found.begin(), found.end(), std::back_inserter(findings));
  drop_overruled(findings);
  Output output;
  output.write(findings_text(findings));
  output.flush();
  if (settings.error) std::rethrow_exception(settings.error);
  if (const std::size_t wrong = count_wrong(findings); wrong > 0) {
    throw Failure(std::to_string(wrong) + (wrong == 1 ? " fault found" : " faults found"));
  }
}

}  // namespace

void add_doctor(Command& program) {
  Command command = program.add_subcommand(
      "doctor",
      "find faults between lidar and pose, with remedies; exit code 1 if there is a fault");
  const auto options = std::make_shared<SettingsOptions>();
  options->add_config(command, kDaemonsConfig);
  command.callback([options] { diagnose(*options); });
}

}  // namespace cornerd::tool
