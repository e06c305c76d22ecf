// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "drivers/config/kernel_odometry_config.hpp"
#include "drivers/odometry/sensor.hpp"

namespace cornerd::drivers {

/// A wheel's encoder by the kernel's counter subsystem.
class Encoder : public Sensor {
 public:
  /// `sysfs`: where that is mounted.
  Encoder(const std::filesystem::path& sysfs, EncoderConfig config);

  /// Looks for the counter where there is none, and whether it is still set up to count. Reads a
  /// handful of files: not for every reading.
  void look();

  /// Counts that grow when the robot rolls forward and never wrap, by the counter's own ceiling.
  /// Nullopt where there is none to be had: see status().
  std::optional<std::int64_t> read();

  std::uint64_t wraps() const { return wraps_; }

 private:
  bool find();
  bool check();

  EncoderConfig config_;
  std::filesystem::path devices_;
  std::filesystem::path folder_;  ///< of the count
  std::int64_t ceiling_ = 0;      ///< 0: it does not wrap
  std::optional<std::int64_t> last_;
  std::int64_t total_ = 0;
  std::uint64_t wraps_ = 0;
};

}  // namespace cornerd::drivers
