// SPDX-License-Identifier: MIT
#include <algorithm>

#include "tool/doctor/checks.hpp"
#include "tool/doctor/process_table.hpp"
#include "tool/doctor/usb_adapters.hpp"

namespace cornerd::tool {

namespace {

namespace fs = std::filesystem;

constexpr const char* kReloadRules =
    "sudo udevadm control --reload && sudo udevadm trigger --subsystem-match=tty";

/// What to do where the port is not there and nothing on USB could be it.
std::vector<std::string> remedies_without_adapter(const std::string& device) {
  if (device.starts_with("/dev/ttyO")) {
    return {"newer kernels call it ttyS: try lidar.device \"/dev/ttyS" + device.substr(9) + "\""};
  }
  if (device.starts_with("/dev/ttyS") || device.starts_with("/dev/ttyAMA")) {
    return {
        "switch the board's UART on: on a BeagleBone an overlay in /boot/uEnv.txt, as "
        "BB-UART4-00A0.dtbo for ttyS4"};
  }
  return {"plug the lidar in; lsusb must then show 10c4:ea60",
          "try another cable: some only charge and lack the wires for data"};
}

/// `why`: what is wrong with the one of the settings.
Finding absent_port(const Patient& patient, const std::vector<UsbAdapter>& adapters,
                    const std::string& why) {
  const std::string device = patient.config.lidar.device.string();
  Finding finding{Verdict::kWrong, "port", device + ": " + why};
  for (const UsbAdapter& adapter : adapters) {
    if (adapter.port.empty()) {
      finding.what += "; an adapter (" + adapter.describe() + ") is plugged in, without a driver";
      finding.remedies.emplace_back(find_process(patient.machine, "brltty")
                                        ? "take it from brltty, see below"
                                        : "sudo modprobe cp210x");
      continue;
    }
    finding.what += "; there is /dev/" + adapter.port + " (" + adapter.describe() + ")";
    if (device == "/dev/rplidar" && adapter.is_cp2102()) {
      finding.remedies.emplace_back(
          has_udev_rules(patient.machine)
              ? kReloadRules
              : "install systemd/61-cornerd.rules in /etc/udev/rules.d, then: " +
                    std::string(kReloadRules));
    }
    finding.remedies.push_back("or set lidar.device to \"/dev/" + adapter.port + "\" in " +
                               patient.config_name);
  }
  if (!finding.remedies.empty() && finding.remedies.front().starts_with("or ")) {
    finding.remedies.front().erase(0, 3);
  }
  if (finding.remedies.empty()) finding.remedies = remedies_without_adapter(device);
  if (patient.machine.exists(device)) {
    finding.remedies.emplace_back(
        "lidar.device must name a port, as /dev/rplidar or /dev/ttyS4 do");
  }
  return finding;
}

Finding found_port(const Patient& patient, const std::vector<UsbAdapter>& adapters) {
  const fs::path& device = patient.config.lidar.device;
  const fs::path port = port_of(patient);
  Finding finding{Verdict::kGood, "port", device.string()};
  if (port != device) finding.what += " -> " + port.string();
  const std::string name = port.filename().string();
  const auto adapter = std::find_if(adapters.begin(), adapters.end(),
                                    [&](const UsbAdapter& one) { return one.port == name; });
  if (adapter != adapters.end()) finding.what += " (" + adapter->describe() + ")";
  for (const UsbAdapter& other : adapters) {
    if (other.port.empty() || other.port == name) continue;
    finding.what += "; also plugged in: /dev/" + other.port + " (" + other.describe() + ")";
  }
  // The kernel makes ttyS0 to ttyS3 whether or not there is a UART; 0 is that there is none.
  if (patient.machine.read_line("/sys/class/tty/" + name + "/type") == "0") {
    finding.verdict = Verdict::kWrong;
    finding.what += ": there is no UART behind it";
    finding.remedies = remedies_without_adapter(port.string());
  }
  return finding;
}

}  // namespace

std::vector<Finding> check_port(const Patient& patient) {
  const settings::LidarConfig& lidar = patient.config.lidar;
  if (lidar.driver == settings::DriverKind::kReplay) {
    if (patient.machine.exists(lidar.file)) {
      return {{Verdict::kNote, "lidar", "is replaced by the recording " + lidar.file.string()}};
    }
    return {{Verdict::kWrong,
             "lidar",
             lidar.file.string() + ": no such recording",
             {"set lidar.file, or lidar.driver to \"rplidar\", in " + patient.config_name}}};
  }
  const std::vector<UsbAdapter> adapters = find_usb_adapters(patient.machine);
  const std::optional<FileFacts> file = patient.machine.facts(lidar.device);
  if (!file) return {absent_port(patient, adapters, "no such port")};
  const std::string other = other_than_port(patient.machine, *file);
  if (!other.empty()) return {absent_port(patient, adapters, "no serial port, but " + other)};
  return {found_port(patient, adapters)};
}

}  // namespace cornerd::tool
