// SPDX-License-Identifier: MIT
#include <algorithm>

#include "tool/doctor/checks.hpp"
#include "tool/doctor/process_table.hpp"

namespace cornerd::tool {

namespace {

std::string remedy_for(const Process& holder, const std::string& port) {
  if (holder.name == "gpsd") return "sudo systemctl disable --now gpsd.socket gpsd";
  if (holder.name == "ModemManager") return "sudo systemctl mask --now ModemManager";
  if (holder.name == "brltty") return "sudo apt remove brltty (it serves Braille displays)";
  if (holder.name == "agetty" || holder.name == "getty" || holder.name == "login") {
    return "it is a login: sudo systemctl disable --now serial-getty@" + port + ".service";
  }
  return "end it: sudo kill " + std::to_string(holder.pid);
}

bool is_console(const Machine& machine, const std::string& port) {
  const std::string consoles = machine.read_line("/sys/class/tty/console/active");
  const auto names = split_words(consoles, " ");
  return std::find(names.begin(), names.end(), port) != names.end();
}

}  // namespace

std::vector<Finding> check_holders(const Patient& patient) {
  if (patient.config.lidar.driver == settings::DriverKind::kReplay) return {};
  if (!has_port(patient)) return {};
  const std::filesystem::path port = port_of(patient);
  const std::string name = port.filename().string();

  std::vector<Finding> findings;
  if (is_console(patient.machine, name)) {
    findings.push_back({Verdict::kWrong,
                        "console",
                        "the kernel uses " + port.string() + " as its console",
                        {"remove console=" + name +
                         " from the kernel's command line (/boot/uEnv.txt "
                         "or the boot loader), or connect the lidar to another UART"}});
  }
  const PortHolders holders = holders_of(patient.machine, port);
  std::string keeper = "nobody";
  for (const Process& process : holders.processes) {
    const std::string title = process.name + " (process " + std::to_string(process.pid) + ")";
    if (process.name == "cornerd") {
      keeper = title;
    } else {
      findings.push_back({Verdict::kWrong,
                          "holder",
                          title + " has " + port.string() + " open",
                          {remedy_for(process, name)}});
    }
  }
  if (findings.empty() && keeper == "nobody" && !holders.complete) {
    findings.push_back({Verdict::kNote,
                        "holder",
                        "no process that you may inspect has " + port.string() + " open",
                        {"run sudo cornerctl doctor to inspect all processes"}});
  } else if (findings.empty()) {
    findings.push_back({Verdict::kGood, "holder", keeper + " has " + port.string() + " open"});
  }
  return findings;
}

}  // namespace cornerd::tool
