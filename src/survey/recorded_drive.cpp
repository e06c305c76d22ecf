// SPDX-License-Identifier: MIT
#include "survey/recorded_drive.hpp"

#include <algorithm>
#include <limits>

namespace cornerd::survey {
namespace {

constexpr core::TimeNs kNsPerUs = 1000;

}  // namespace

void RecordedDrive::add(const core::Scan& scan) {
  scans_.push_back({scan.start_ns(), samples_.size(), scan.size()});
  for (const core::Sample& sample : scan.samples()) {
    const core::TimeNs after_us = (sample.t_ns - scan.start_ns()) / kNsPerUs;
    constexpr core::TimeNs kMax = std::numeric_limits<std::int32_t>::max();
    samples_.push_back({static_cast<std::int32_t>(std::clamp(after_us, -kMax, kMax)),
                        sample.bearing_rad, sample.range_m});
  }
}

void RecordedDrive::set_odometry(const std::vector<core::OdometryReading>& readings) {
  readings_.clear();
  has_wheels_ = has_gyro_ = false;
  std::size_t index = 0;
  for (const core::OdometryReading& reading : readings) {
    while (index < scans_.size() && end_ns(index) < reading.t_ns) ++index;
    keep({reading.arrived(reading.t_ns), index});
  }
}

void RecordedDrive::keep(const Reading& reading) {
  has_wheels_ |= reading.reading.left && reading.reading.right;
  has_gyro_ |= reading.reading.gyro_rad_s.has_value();
  readings_.push_back(reading);
}

RecordedDrive RecordedDrive::without_odometry() const {
  RecordedDrive drive;
  drive.scans_ = scans_;
  drive.samples_ = samples_;
  return drive;
}

core::TimeNs RecordedDrive::end_ns(std::size_t index) const {
  const StoredScan& stored = scans_[index];
  if (stored.size == 0) return stored.start_ns;
  return stored.start_ns + samples_[stored.first + stored.size - 1].after_us * kNsPerUs;
}

void RecordedDrive::load(std::size_t index, core::Scan& scan) const {
  scan.clear();
  const StoredScan& stored = scans_[index];
  for (std::size_t i = 0; i < stored.size; ++i) {
    const StoredSample& from = samples_[stored.first + i];
    core::Sample sample;
    sample.t_ns = stored.start_ns + from.after_us * kNsPerUs;
    sample.bearing_rad = from.bearing_rad;
    sample.range_m = from.range_m;
    sample.starts_scan = i == 0;
    sample.ends_scan = i + 1 == stored.size;
    scan.add(sample);
  }
}

}  // namespace cornerd::survey
