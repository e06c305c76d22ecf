// SPDX-License-Identifier: MIT
#include "tool/doctor/usb_adapters.hpp"

#include <algorithm>
#include <iterator>
#include <vector>

namespace cornerd::tool {

namespace {

UsbAdapter read_usb_device(const Machine& machine, const std::filesystem::path& device) {
  return {"", machine.read_line(device / "idVendor"), machine.read_line(device / "idProduct"),
          machine.read_line(device / "product"), device};
}

/// The USB device of a port's folder; empty if it has none.
std::filesystem::path usb_device_of(const Machine& machine, std::filesystem::path folder) {
  while (folder.has_relative_path()) {
    if (machine.exists(folder / "idVendor")) return folder;
    folder = folder.parent_path();
  }
  return {};
}

}  // namespace

std::string UsbAdapter::describe() const {
  return (title.empty() ? "" : title + ", ") + vendor + ":" + product;
}

std::vector<UsbAdapter> find_usb_adapters(const Machine& machine) {
  std::vector<UsbAdapter> adapters;
  for (const std::string& name : machine.list("/sys/class/tty")) {
    if (!name.starts_with("ttyUSB") && !name.starts_with("ttyACM")) continue;
    const auto device = usb_device_of(machine, machine.resolve("/sys/class/tty/" + name));
    UsbAdapter adapter = read_usb_device(machine, device);
    adapter.port = name;
    adapters.push_back(adapter);
  }
  for (const std::string& name : machine.list("/sys/bus/usb/devices")) {
    const auto device = machine.resolve("/sys/bus/usb/devices/" + name);
    const UsbAdapter adapter = read_usb_device(machine, device);
    const bool known = std::any_of(adapters.begin(), adapters.end(),
                                   [&](const UsbAdapter& one) { return one.device == device; });
    if (adapter.is_cp2102() && !known) adapters.push_back(adapter);
  }
  return adapters;
}

bool has_udev_rules(const Machine& machine) {
  constexpr const char* kFolders[] = {"/lib/udev/rules.d", "/usr/lib/udev/rules.d",
                                      "/etc/udev/rules.d"};
  return std::any_of(std::begin(kFolders), std::end(kFolders), [&](const char* folder) {
    const std::vector<std::string> names = machine.list(folder);
    return std::any_of(names.begin(), names.end(),
                       [](const std::string& name) { return name.ends_with("-cornerd.rules"); });
  });
}

std::optional<std::string> udev_notes(const Machine& machine, const std::string& port) {
  const std::string number = machine.read_line("/sys/class/tty/" + port + "/dev");
  return number.empty() ? std::nullopt : machine.read("/run/udev/data/c" + number);
}

}  // namespace cornerd::tool
