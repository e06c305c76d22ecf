// SPDX-License-Identifier: MIT
// Encoders and a gyro that the Linux kernel drives.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "drivers/config/kernel_odometry_config.hpp"
#include "drivers/odometry/odometry_driver.hpp"
#include "drivers/odometry/sysfs.hpp"

namespace cornerd::drivers {

/// An integer attribute of sysfs and its state. Once open, reading allocates nothing.
class KernelSensor {
 public:
  const SensorStatus& status() const { return status_; }
  /// Ignored unless the sensor runs; see StuckDetector.
  void set_stuck(bool stuck);
  std::uint64_t failed_reads() const { return failed_reads_; }
  std::uint64_t invalid_values() const { return invalid_values_; }

 protected:
  void set_state(SensorState state, std::string_view detail = {});
  /// Opens the attribute for read_raw(). On failure sets the state and returns false.
  bool open(const std::filesystem::path& file);
  void close(SensorState state, std::string_view detail);
  bool is_open() const { return attribute_.is_open(); }
  bool is_current() const { return attribute_.is_current(); }
  /// On failure sets the state and returns nullopt.
  std::optional<std::int64_t> read_raw();

 private:
  void fail(int error);

  Attribute attribute_;
  SensorStatus status_;
  std::uint64_t failed_reads_ = 0;
  std::uint64_t invalid_values_ = 0;
};

/// A wheel encoder of the kernel's counter subsystem.
class Encoder : public KernelSensor {
 public:
  /// `sysfs`: its mount point.
  Encoder(const std::filesystem::path& sysfs, EncoderConfig config);

  /// Finds the counter if it is missing, and checks that it is set up to count. Reads several
  /// files: call it about once a second.
  void refresh();

  /// Counts, growing when the robot rolls forward, unwrapped by the counter's `ceiling`. Nullopt on
  /// failure: see status().
  std::optional<std::int64_t> read();

  std::uint64_t wraps() const { return wraps_; }

 private:
  bool find();
  bool check();

  EncoderConfig config_;
  std::filesystem::path devices_;
  std::filesystem::path folder_;  ///< of the count
  std::int64_t ceiling_ = 0;      ///< 0: does not wrap
  std::optional<std::int64_t> last_;
  std::int64_t total_ = 0;
  std::uint64_t wraps_ = 0;
};

/// A gyro of the kernel's industrial I/O subsystem.
class Gyro : public KernelSensor {
 public:
  /// `sysfs`: its mount point.
  Gyro(const std::filesystem::path& sysfs, GyroConfig config);

  /// As Encoder::refresh(); also reads the scale, which changes with the range.
  void refresh();

  /// (raw + offset) * scale, rad/s, counter-clockwise. Nullopt on failure: see status().
  std::optional<double> read();

 private:
  bool read_scale();
  /// The axis' own attribute, else the one for all axes.
  std::optional<std::string> read_of_axis(const char* what) const;

  GyroConfig config_;
  std::filesystem::path devices_;
  std::filesystem::path folder_;
  double scale_rad_s_ = 0;
  double offset_ = 0;
};

}  // namespace cornerd::drivers
