// SPDX-License-Identifier: MIT
#include <algorithm>
#include <sstream>

#include "tool/doctor/checks.hpp"
#include "tool/doctor/process_table.hpp"
#include "tool/doctor/usb_adapters.hpp"

namespace cornerd::tool {

namespace {

constexpr const char* kGpsdSettings = "/etc/default/gpsd";

/// The value of NAME="value" in a shell settings file; empty if it is absent.
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

/// gpsd's udev rules start gpsd for every CP2102; the package's rules exclude the lidar.
bool is_claimed_by_gpsd(const Machine& machine, const std::string& port) {
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
         "is configured to read " + port.string() + " as a GPS receiver",
         {"remove it from DEVICES in " + settings + ", then: sudo systemctl restart gpsd"}});
  } else if (is_usb && is_claimed_by_gpsd(machine, port.filename().string())) {
    findings.push_back(
        {Verdict::kWrong,
         "gpsd",
         "treats every CP2102 as a GPS receiver, the lidar's too",
         {"install the package's udev rules (61-cornerd.rules) and plug the lidar in again",
          "or set USBAUTO=\"false\" in " + settings + ", then: sudo systemctl restart gpsd"}});
  } else {
    findings.push_back({Verdict::kGood, "gpsd", "is installed and leaves the port alone"});
  }
}

void check_modem_manager(const Machine& machine, const std::string& name, bool is_usb,
                         std::vector<Finding>& findings) {
  if (!is_usb || !find_process(machine, "ModemManager")) return;
  const std::optional<std::string> notes = udev_notes(machine, name);
  // An absent port has no udev data: the installed rules decide.
  const bool is_ignored = notes ? notes->find("E:ID_MM_PORT_IGNORE=1") != std::string::npos ||
                                      notes->find("E:ID_MM_DEVICE_IGNORE=1") != std::string::npos
                                : !machine.exists("/dev/" + name) && has_udev_rules(machine);
  if (is_ignored) {
    findings.push_back({Verdict::kGood, "modems", "ModemManager runs and leaves the port alone"});
    return;
  }
  findings.push_back(
      {Verdict::kWrong,
       "modems",
       "ModemManager probes every new port for a modem, the lidar's too",
       {"install the package's udev rules (61-cornerd.rules) and plug the lidar in again",
        "or, if there is no modem: sudo systemctl mask --now ModemManager"}});
}

/// The name of the lidar's port if it is behind USB, present or not; else empty.
std::string usb_port_name(const Patient& patient, const std::vector<UsbAdapter>& adapters) {
  const std::string name = port_of(patient).filename().string();
  const auto has_name = [&](const UsbAdapter& one) { return one.port == name; };
  if (std::any_of(adapters.begin(), adapters.end(), has_name)) return name;
  const bool is_uart =
      name.starts_with("tty") && !name.starts_with("ttyUSB") && !name.starts_with("ttyACM");
  if (is_uart || has_port(patient)) return {};
  const auto under_another_name =
      std::find_if(adapters.begin(), adapters.end(),
                   [](const UsbAdapter& one) { return one.is_cp2102() && !one.port.empty(); });
  return under_another_name == adapters.end() ? name : under_another_name->port;
}

void check_brltty(const Machine& machine, const std::vector<UsbAdapter>& adapters,
                  std::vector<Finding>& findings) {
  if (!find_process(machine, "brltty")) return;
  Finding finding{Verdict::kWrong,
                  "brltty",
                  "treats every CP2102 as a Braille display",
                  {"sudo apt remove brltty, unless somebody needs it"}};
  const auto taken = std::find_if(adapters.begin(), adapters.end(),
                                  [](const UsbAdapter& one) { return one.port.empty(); });
  if (taken != adapters.end()) {
    finding.what += ", and probably has the lidar's: an adapter is plugged in and has no port";
    finding.remedies.emplace_back("then plug the lidar in again");
  }
  findings.push_back(finding);
}

}  // namespace

std::vector<Finding> check_claimers(const Patient& patient) {
  if (patient.config.lidar.driver == settings::DriverKind::kReplay) return {};
  const Machine& machine = patient.machine;
  const std::vector<UsbAdapter> adapters = find_usb_adapters(machine);
  const std::string usb_name = usb_port_name(patient, adapters);
  const bool is_usb = !usb_name.empty();
  std::vector<Finding> findings;
  const std::filesystem::path port = is_usb ? "/dev/" + usb_name : port_of(patient).string();
  check_gpsd(machine, port, is_usb, findings);
  check_modem_manager(machine, usb_name, is_usb, findings);
  if (is_usb) check_brltty(machine, adapters, findings);
  if (findings.empty()) {
    findings.push_back(
        {Verdict::kGood, "claimers", "neither gpsd, ModemManager nor brltty claims the port"});
  }
  return findings;
}

}  // namespace cornerd::tool
