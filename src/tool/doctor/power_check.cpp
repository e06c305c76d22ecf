// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <charconv>
#include <sstream>

#include "tool/doctor/checks.hpp"
#include "tool/doctor/usb_adapters.hpp"

namespace cornerd::tool {

namespace {

constexpr const char* kPowerRemedy =
    "the A1 needs 4.9 to 5.5 V and up to 0.6 A at start: use a stronger supply, a shorter cable, "
    "or a powered hub";

unsigned sysfs_number(const Machine& machine, const std::filesystem::path& file, int base) {
  const std::string text = machine.read_line(file);
  unsigned number = 0;
  std::from_chars(text.data(), text.data() + text.size(), number, base);
  return number;
}

/// How often USB ports were switched off by over-current.
unsigned count_over_currents(const Machine& machine) {
  unsigned count = 0;
  const std::filesystem::path devices = "/sys/bus/usb/devices";
  for (const std::string& name : machine.list(devices)) {
    if (name.find(':') == std::string::npos) continue;
    for (const std::string& port : machine.list(devices / name)) {
      if (port.find("-port") == std::string::npos) continue;
      count += sysfs_number(machine, devices / name / port / "over_current_count", 10);
    }
  }
  return count;
}

/// True if a hwmon sensor, such as a Raspberry Pi's, reports under-voltage now.
bool is_undervolted(const Machine& machine) {
  const std::filesystem::path monitors = "/sys/class/hwmon";
  for (const std::string& monitor : machine.list(monitors)) {
    for (const std::string& file : machine.list(monitors / monitor)) {
      if (file.starts_with("in") && file.ends_with("_lcrit_alarm") &&
          machine.read_line(monitors / monitor / file) == "1") {
        return true;
      }
    }
  }
  return false;
}

/// True behind a bus-powered hub.
bool is_behind_unpowered_hub(const Machine& machine, const UsbAdapter& adapter) {
  const std::filesystem::path hub = adapter.device.parent_path();
  constexpr unsigned kSelfPowered = 0x40;  // USB 2.0, 9.6.3: bmAttributes
  const std::string attributes = machine.read_line(hub / "bmAttributes");
  return !attributes.empty() && !hub.filename().string().starts_with("usb") &&
         (sysfs_number(machine, hub / "bmAttributes", 16) & kSelfPowered) == 0;
}

struct Trace {
  std::string_view word;  ///< what the kernel writes
  const char* meaning;
};
constexpr std::array kKernelMessages = {
    Trace{"nder-voltage detected", "the board's own supply was too low"},
    Trace{"ndervoltage detected", "the board's own supply was too low"},
    Trace{"over-current", "a USB port was overloaded"},
    Trace{"disabled by hub (EMI?)", "a USB port was disturbed"},
    Trace{"cp210x converter now disconnected",
          "the lidar's adapter was unplugged or lost its power"},
    Trace{"device descriptor read/64, error", "a USB device did not answer (bad cable?)"},
};

/// One finding for each kind of message in the kernel's log.
void read_kernel_log(const std::string& log, std::vector<Finding>& findings) {
  for (const Trace& trace : kKernelMessages) {
    std::size_t count = 0;
    std::istringstream lines(log);
    for (std::string line; std::getline(lines, line);) {
      if (line.find(trace.word) != std::string::npos) ++count;
    }
    if (count == 0) continue;
    findings.push_back({Verdict::kNote,
                        "power",
                        std::string(trace.meaning) + ", " + std::to_string(count) +
                            (count == 1 ? " time" : " times") + " in the kernel's log",
                        {kPowerRemedy}});
  }
}

}  // namespace

std::vector<Finding> check_power(const Patient& patient) {
  if (patient.config.lidar.driver == settings::DriverKind::kReplay) return {};
  const Machine& machine = patient.machine;
  std::vector<Finding> findings;
  if (is_undervolted(machine)) {
    findings.push_back(
        {Verdict::kWrong, "power", "the board's supply is too low now", {kPowerRemedy}});
  }
  if (const unsigned count = count_over_currents(machine); count > 0) {
    findings.push_back({Verdict::kWrong,
                        "power",
                        "USB ports were switched off by too much current, " +
                            std::to_string(count) + " times since the start",
                        {kPowerRemedy}});
  }
  const std::string name = port_of(patient).filename().string();
  for (const UsbAdapter& adapter : find_usb_adapters(machine)) {
    if (adapter.port == name && is_behind_unpowered_hub(machine, adapter)) {
      findings.push_back({Verdict::kNote,
                          "power",
                          "the lidar is on a hub without its own supply",
                          {kPowerRemedy}});
    }
  }
  const std::optional<std::string> log = machine.read("/dev/kmsg");
  if (log) read_kernel_log(*log, findings);
  if (findings.empty()) {
    findings.push_back({Verdict::kGood, "power",
                        log ? "no trace of trouble"
                            : "no trace of trouble in /sys; sudo cornerctl "
                              "doctor reads the kernel's log too"});
  }
  return findings;
}

}  // namespace cornerd::tool
