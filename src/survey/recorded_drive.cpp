// SPDX-License-Identifier: MIT
#include "survey/recorded_drive.hpp"

#include <algorithm>
#include <limits>

namespace cornerd::survey {
namespace {

constexpr core::TimeNs kNsPerUs = 1000;

}  // namespace

void RecordedDrive::add(const core::Scan& turn) {
  turns_.push_back({turn.start_ns(), samples_.size(), turn.size()});
  for (const core::Sample& sample : turn.samples()) {
    const core::TimeNs after_us = (sample.t_ns - turn.start_ns()) / kNsPerUs;
    constexpr core::TimeNs kMost = std::numeric_limits<std::int32_t>::max();
    samples_.push_back({static_cast<std::int32_t>(std::clamp(after_us, -kMost, kMost)),
                        sample.bearing_rad, sample.range_m});
  }
}

void RecordedDrive::set_odometry(const std::vector<core::OdometryReading>& readings) {
  readings_.clear();
  has_wheels_ = has_gyro_ = false;
  std::size_t turn = 0;
  for (const core::OdometryReading& reading : readings) {
    while (turn < turns_.size() && end_ns(turn) < reading.t_ns) ++turn;
    keep({reading, reading.t_ns, turn});
  }
}

void RecordedDrive::keep(const Reading& reading) {
  has_wheels_ |= reading.reading.left && reading.reading.right;
  has_gyro_ |= reading.reading.gyro_rad_s.has_value();
  readings_.push_back(reading);
}

RecordedDrive RecordedDrive::without_odometry() const {
  RecordedDrive drive;
  drive.turns_ = turns_;
  drive.samples_ = samples_;
  return drive;
}

core::TimeNs RecordedDrive::end_ns(std::size_t turn) const {
  const Turn& stored = turns_[turn];
  if (stored.size == 0) return stored.start_ns;
  return stored.start_ns + samples_[stored.first + stored.size - 1].after_us * kNsPerUs;
}

void RecordedDrive::load(std::size_t turn, core::Scan& scan) const {
  scan.clear();
  const Turn& stored = turns_[turn];
  for (std::size_t i = 0; i < stored.size; ++i) {
    const StoredSample& from = samples_[stored.first + i];
    core::Sample sample;
    sample.t_ns = stored.start_ns + from.after_us * kNsPerUs;
    sample.bearing_rad = from.bearing_rad;
    sample.range_m = from.range_m;
    sample.starts_turn = i == 0;
    sample.ends_turn = i + 1 == stored.size;
    scan.add(sample);
  }
}

}  // namespace cornerd::survey
