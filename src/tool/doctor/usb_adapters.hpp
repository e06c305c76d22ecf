// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "tool/doctor/machine.hpp"

namespace cornerd::tool {

/// A USB serial adapter, with or without a driver.
struct UsbAdapter {
  std::string port;                ///< "ttyUSB0"; empty: no driver has taken it
  std::string vendor;              ///< "10c4"
  std::string product;             ///< "ea60"
  std::string title;               ///< as it calls itself; may be empty
  std::filesystem::path device{};  ///< its folder below /sys/devices

  /// The chip on the A1's own USB board.
  bool is_cp2102() const { return vendor == "10c4" && product == "ea60"; }
  /// "CP2102 USB to UART Bridge Controller, 10c4:ea60"
  std::string describe() const;
};

/// All that have a port, and CP2102s without one.
std::vector<UsbAdapter> find_usb_adapters(const Machine& machine);

/// True if the package's rules, or a copy, are in a folder that udev reads.
bool has_udev_rules(const Machine& machine);

/// udev's database entry of a port ("ttyUSB0"), lines such as "E:ID_MODEL=CP2102"; nullopt if none.
std::optional<std::string> udev_notes(const Machine& machine, const std::string& port);

}  // namespace cornerd::tool
