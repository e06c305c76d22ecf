// SPDX-License-Identifier: MIT
#include <algorithm>
#include <sstream>

#include "tool/doctor/checks.hpp"
#include "tool/doctor/process_table.hpp"
#include "tool/doctor/udev_notes.hpp"
#include "tool/doctor/usb_adapters.hpp"

namespace cornerd::tool {

namespace {

constexpr const char* kGpsdSettings = "/etc/default/gpsd";

/// The value of a line NAME="value" of a file that a shell would read; empty where there is none.
std::string shell_value(const Machine& machine, const char* file, std::string_view name) {
  std::istringstream lines(machine.read(file).value_or(""));
  std::string value;
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with(name) || line.size() <= name.size() || line[name.size()] != '=') continue;
    value = line.substr(name.size() + 1);
    std::erase_if(value, [](char c) { return c == '"' || c == '\''; });
  }
  return value;
}

/// gpsd's own rules have udev ask for its service with every CP2102; the package's take that back.
bool is_asked_of_gpsd(const Machine& machine, const std::string& port) {
  if (shell_value(machine, kGpsdSettings, "USBAUTO") != "true") return false;
  const std::optional<std::string> notes = udev_notes(machine, port);
  return notes ? notes->find("gpsdctl@") != std::string::npos : !has_udev_rules(machine);
}

void check_gpsd(const Machine& machine, const std::filesystem::path& port, bool is_usb,
                std::vector<Finding>& findings) {
  if (!machine.exists(kGpsdSettings) && !find_process(machine, "gpsd")) return;
  const std::string settings = kGpsdSettings;
  const std::string devices = shell_value(machine, kGpsdSettings, "DEVICES");
  const auto named = split_words(devices, " ");
  if (std::any_of(named.begin(), named.end(),
                  [&](std::string_view one) { return machine.resolve(one) == port; })) {
    findings.push_back(
        {Verdict::kWrong,
         "gpsd",
         "is told to read " + port.string() + " as a GPS receiver",
         {"take it out of DEVICES in " + settings + ", then: sudo systemctl restart gpsd"}});
  } else if (is_usb && is_asked_of_gpsd(machine, port.filename().string())) {
    findings.push_back(
        {Verdict::kWrong,
         "gpsd",
         "takes every CP2102 that is plugged in for a GPS receiver, the lidar's too",
         {"install the package's udev rules (61-cornerd.rules) and plug the lidar in again",
          "or set USBAUTO=\"false\" in " + settings + ", then: sudo systemctl restart gpsd"}});
  } else {
    findings.push_back({Verdict::kGood, "gpsd", "is installed and leaves the port alone"});
  }
}

void check_modem_manager(const Machine& machine, const std::string& name, bool is_usb,
                         std::vector<Finding>& findings) {
  if (!is_usb || !find_process(machine, "ModemManager")) return;
  const std::string notes = udev_notes(machine, name).value_or("");
  if (notes.find("E:ID_MM_PORT_IGNORE=1") != std::string::npos ||
      notes.find("E:ID_MM_DEVICE_IGNORE=1") != std::string::npos) {
    findings.push_back({Verdict::kGood, "modems", "ModemManager runs and leaves the port alone"});
    return;
  }
  findings.push_back(
      {Verdict::kWrong,
       "modems",
       "ModemManager talks to every new port as to a modem, the lidar's too",
       {"install the package's udev rules (61-cornerd.rules) and plug the lidar in again",
        "or, where there is no modem: sudo systemctl mask --now ModemManager"}});
}

}  // namespace

std::vector<Finding> check_claimers(const Patient& patient) {
  if (patient.config.lidar.driver == settings::DriverKind::kReplay) return {};
  const Machine& machine = patient.machine;
  const std::filesystem::path port = port_of(patient);
  const std::string name = port.filename().string();
  const std::vector<UsbAdapter> adapters = find_usb_adapters(machine);
  const bool is_usb = std::any_of(adapters.begin(), adapters.end(),
                                  [&](const UsbAdapter& one) { return one.port == name; });
  std::vector<Finding> findings;
  check_gpsd(machine, port, is_usb, findings);
  check_modem_manager(machine, name, is_usb, findings);
  if (is_usb && find_process(machine, "brltty")) {
    findings.push_back({Verdict::kWrong,
                        "brltty",
                        "takes CP2102s for Braille displays",
                        {"sudo apt remove brltty, unless somebody reads by it"}});
  }
  if (findings.empty()) {
    findings.push_back(
        {Verdict::kGood, "claimers", "neither gpsd, ModemManager nor brltty is after the port"});
  }
  return findings;
}

}  // namespace cornerd::tool
