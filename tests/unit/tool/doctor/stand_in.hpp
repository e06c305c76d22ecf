// SPDX-License-Identifier: MIT
#pragma once

#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "tests/temporary_folder.hpp"
#include "tool/doctor/finding.hpp"
#include "tool/doctor/patient.hpp"

namespace cornerd::tool {

/// A machine of files, for the checks to look at.
class StandIn {
 public:
  StandIn() {
    patient.machine = Machine(folder_.path(), /*files_are_devices=*/true);
    patient.config.lidar.device = "/dev/rplidar";
    patient.config_name = "cornerd.json";
    patient.caller = {"ada", 1000, {1000}};
  }

  void write(const std::string& file, const std::string& text = "") const {
    const std::filesystem::path place = folder_.path() / file.substr(1);
    std::filesystem::create_directories(place.parent_path());
    std::ofstream(place) << text;
  }
  void link(const std::string& file, const std::string& target) const {
    const std::filesystem::path place = folder_.path() / file.substr(1);
    std::filesystem::create_directories(place.parent_path());
    std::filesystem::create_symlink(target, place);
  }
  /// "/dev/null": the number of a file that stands for a device is 0:0.
  void be_no_terminal() const { link("/sys/dev/char/0:0/subsystem", "../../../class/mem"); }
  std::filesystem::path outside(const std::string& file) const {
    return folder_.path() / file.substr(1);
  }
  void allow(const std::string& file, unsigned mode) const {
    std::filesystem::permissions(folder_.path() / file.substr(1),
                                 static_cast<std::filesystem::perms>(mode));
  }
  /// An A1's adapter, as udev's rules leave it.
  void plug_in() const {
    write("/dev/ttyUSB0");
    link("/dev/rplidar", "ttyUSB0");
    plug_in_without_rules();
  }
  void plug_in_without_rules() const {
    const std::string device = "/sys/devices/pci0/usb1/1-1";
    write("/dev/ttyUSB0");
    write(device + "/idVendor", "10c4\n");
    write(device + "/idProduct", "ea60\n");
    write(device + "/product", "CP2102 USB to UART Bridge Controller\n");
    write(device + "/1-1:1.0/ttyUSB0/tty/ttyUSB0/dev", "188:0\n");
    link("/sys/class/tty/ttyUSB0", "../../devices/pci0/usb1/1-1/1-1:1.0/ttyUSB0/tty/ttyUSB0");
    link("/sys/bus/usb/devices/1-1", "../../../devices/pci0/usb1/1-1");
  }
  void run_process(int pid, const std::string& name) const {
    write("/proc/" + std::to_string(pid) + "/comm", name + "\n");
  }

  Patient patient;

 private:
  test::TemporaryFolder folder_;
};

/// A finding with this verdict and subject, and a text that matches.
MATCHER_P3(Finds, verdict, subject, what, "") {
  *result_listener << arg.subject << ": " << arg.what;
  for (const std::string& mend : arg.remedies) *result_listener << " -> " << mend;
  return arg.verdict == verdict && arg.subject == subject &&
         testing::ExplainMatchResult(testing::HasSubstr(what), arg.what, result_listener);
}

inline void PrintTo(const Finding& finding, std::ostream* out) {
  *out << findings_text({&finding, 1});
}

}  // namespace cornerd::tool
