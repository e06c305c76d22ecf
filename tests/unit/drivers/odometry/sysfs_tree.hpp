// SPDX-License-Identifier: MIT
// A folder with the files and texts that Linux 6.1 has in sysfs for ti-eqep and inv-mpu6050.
#pragma once

#include <filesystem>
#include <fstream>
#include <string>

#include "tests/temporary_folder.hpp"

namespace cornerd::test {

class SysfsTree {
 public:
  const std::filesystem::path& root() const { return folder_.path(); }

  /// An eQEP as the udev rule sets it up; `number` follows the order of probing.
  void add_counter(int number, const std::string& name) {
    const std::string device = counter(number);
    write(device + "/name", name);
    write(device + "/num_counts", "1");
    write(device + "/num_signals", "2");
    write(device + "/count0/name", "QPOSCNT");
    write(device + "/count0/count", "0");
    write(device + "/count0/ceiling", "4294967295");
    write(device + "/count0/enable", "1");
    write(device + "/count0/function", "quadrature x4");
  }
  void set_count(int number, const std::string& text) {
    write(counter(number) + "/count0/count", text);
  }
  void set_of_count(int number, const std::string& attribute, const std::string& text) {
    write(counter(number) + "/count0/" + attribute, text);
  }
  static std::string counter(int number) {
    return "bus/counter/devices/counter" + std::to_string(number);
  }

  /// An MPU-6050 at its widest range.
  void add_gyro(int number, const std::string& name) {
    const std::string device = gyro(number);
    write(device + "/name", name);
    write(device + "/in_anglvel_scale", "0.001064724");
    for (const char* axis : {"x", "y", "z"}) {
      write(device + "/in_anglvel_" + axis + "_raw", "0");
    }
    write(device + "/in_accel_scale", "0.000598");
  }
  void set_rate(int number, const std::string& text) {
    write(gyro(number) + "/in_anglvel_z_raw", text);
  }
  static std::string gyro(int number) {
    return "bus/iio/devices/iio:device" + std::to_string(number);
  }

  /// In place, so that an open descriptor reads the new text.
  void write(const std::string& file, const std::string& text) {
    std::filesystem::create_directories((folder_ / file).parent_path());
    std::ofstream(folder_ / file) << text << '\n';
  }
  void remove(const std::string& file) { std::filesystem::remove_all(folder_ / file); }
  void rename(const std::string& from, const std::string& to) {
    std::filesystem::rename(folder_ / from, folder_ / to);
  }

 private:
  TemporaryFolder folder_;
};

}  // namespace cornerd::test
