// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/odometry/odometry_reading.hpp"
#include "core/scan.hpp"

namespace cornerd::survey {

/// A whole drive in memory, 12 bytes a sample: it is gone through more than once.
class RecordedDrive {
 public:
  struct Reading {
    core::OdometryReading reading;
    std::optional<core::TimeNs> now_ns;  ///< of the lidar's newest sample when it came
    std::size_t scan = 0;                ///< that was going on
  };

  void add(const core::Scan& scan);
  void add(const core::OdometryReading& reading, std::optional<core::TimeNs> now_ns) {
    keep({reading, now_ns, scans_.size()});
  }

  /// Readings of another file, in place of those that came with the turns.
  void set_odometry(const std::vector<core::OdometryReading>& readings);

  std::size_t size() const { return scans_.size(); }
  /// What its readings tell of: a gyro without wheels tells no way.
  bool has_wheels() const { return has_wheels_; }
  bool has_gyro() const { return has_gyro_; }
  RecordedDrive without_odometry() const;

  /// In the order of their arrival.
  std::span<const Reading> readings() const { return readings_; }

  /// Times of a turn: its first sample, and its last one.
  core::TimeNs start_ns(std::size_t index) const { return scans_[index].start_ns; }
  core::TimeNs end_ns(std::size_t index) const;
  core::TimeNs middle_ns(std::size_t index) const {
    return start_ns(index) + (end_ns(index) - start_ns(index)) / 2;
  }

  /// The turn as it came, without the samples' quality.
  void load(std::size_t index, core::Scan& scan) const;

 private:
  struct StoredScan {
    core::TimeNs start_ns = 0;
    std::size_t first = 0;
    std::size_t size = 0;
  };
  struct StoredSample {
    std::int32_t after_us = 0;  ///< the turn's start
    float bearing_rad = 0;
    float range_m = 0;
  };

  void keep(const Reading& reading);

  bool has_wheels_ = false;
  bool has_gyro_ = false;
  std::vector<StoredScan> scans_;
  std::vector<StoredSample> samples_;
  std::vector<Reading> readings_;
};

}  // namespace cornerd::survey
