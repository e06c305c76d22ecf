// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string_view>

#include "drivers/odometry/attribute.hpp"
#include "drivers/odometry/odometry_driver.hpp"

namespace cornerd::drivers {

/// What encoders and gyros of the kernel have in common: an attribute that holds an integer, and
/// ways to be missing. Once open, reading allocates nothing.
class Sensor {
 public:
  const SensorStatus& status() const { return status_; }
  /// For one that runs: whether what it says can be true (FreezeWatch).
  void set_frozen(bool frozen);
  std::uint64_t failed_reads() const { return failed_reads_; }
  std::uint64_t garbage() const { return garbage_; }

 protected:
  void set_state(SensorState state, std::string_view detail = {});
  /// Opens the attribute that read_raw() reads. False where that fails: the status says why.
  bool open(const std::filesystem::path& file);
  void close(SensorState state, std::string_view detail);
  bool is_open() const { return attribute_.is_open(); }
  bool is_current() const { return attribute_.is_current(); }
  /// Nullopt where it fails: the status says why.
  std::optional<std::int64_t> read_raw();

 private:
  void fail(int error);

  Attribute attribute_;
  SensorStatus status_;
  std::uint64_t failed_reads_ = 0;
  std::uint64_t garbage_ = 0;
};

}  // namespace cornerd::drivers
