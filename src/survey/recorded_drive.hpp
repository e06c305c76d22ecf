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

/// A whole drive in memory, 12 bytes a sample, for several passes.
class RecordedDrive {
 public:
  struct Reading {
    core::OdometryReading reading;
    std::size_t scan = 0;  ///< index of the scan that was being received
  };

  void add(const core::Scan& scan);
  void add(const core::OdometryReading& reading) { keep({reading, scans_.size()}); }

  /// Replaces the readings by those of another file.
  void set_odometry(const std::vector<core::OdometryReading>& readings);

  std::size_t size() const { return scans_.size(); }
  /// Whether any reading has both wheel counts, and whether any has a gyro rate.
  bool has_wheels() const { return has_wheels_; }
  bool has_gyro() const { return has_gyro_; }
  RecordedDrive without_odometry() const;

  /// In the order of their arrival.
  std::span<const Reading> readings() const { return readings_; }

  /// Times of a scan's first and last sample, and their middle.
  core::TimeNs start_ns(std::size_t index) const { return scans_[index].start_ns; }
  core::TimeNs end_ns(std::size_t index) const;
  core::TimeNs middle_ns(std::size_t index) const {
    return start_ns(index) + (end_ns(index) - start_ns(index)) / 2;
  }

  /// The scan as received, without the samples' quality.
  void load(std::size_t index, core::Scan& scan) const;

 private:
  struct StoredScan {
    core::TimeNs start_ns = 0;
    std::size_t first = 0;
    std::size_t size = 0;
  };
  struct StoredSample {
    std::int32_t after_us = 0;  ///< since the scan's start
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
