// SPDX-License-Identifier: MIT
#include "replay/simulator/time_of_flight_source.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace cornerd::replay {
namespace {

constexpr std::uint8_t kNodeQuality = 47;   ///< of 63
constexpr std::uint8_t kByteQuality = 188;  ///< the same of 255

double wrapped_deg(double angle_deg) { return angle_deg - 360 * std::floor(angle_deg / 360); }

std::uint32_t units(double value, double per_unit) {
  return static_cast<std::uint32_t>(std::llround(value * per_unit));
}

std::uint32_t angle_q6_of(double angle_deg) {
  return units(wrapped_deg(angle_deg), 64) % (360 * 64);
}

/// 20 bits of an ultra-dense sample: the coarser the farther.
std::uint32_t scaled_sample(std::uint32_t mm) {
  if (mm <= 2046) return static_cast<std::uint32_t>(kByteQuality) << 12 | (mm + 1) / 2 << 2;
  if (mm <= 8187) return (kByteQuality >> 1U) << 13 | (mm - 2046 + 1) / 3 << 2 | 1U;
  if (mm <= 24567) return (kByteQuality >> 2U) << 14 | (mm - 8187 + 2) / 4 << 2 | 2U;
  return (kByteQuality >> 3U) << 15 | (mm - 24567 + 2) / 5 << 2 | 3U;
}

/// CRC-32 bit by bit, over the bytes and zeros up to a multiple of four.
std::uint32_t padded_crc(std::vector<std::uint8_t> bytes) {
  bytes.resize((bytes.size() + 3) / 4 * 4);
  std::uint32_t remainder = ~0U;
  for (const std::uint8_t byte : bytes) {
    remainder ^= byte;
    for (int i = 0; i < 8; ++i) {
      const bool carry = (remainder & 1) != 0;
      remainder >>= 1;
      if (carry) remainder ^= 0xEDB88320;
    }
  }
  return ~remainder;
}

}  // namespace

TimeOfFlightSource::TimeOfFlightSource(std::unique_ptr<Scene> scene, const SimulatorConfig& config,
                                       core::TimeNs sample_period_ns)
    : simulator_(std::move(scene), config, sample_period_ns) {}

void TimeOfFlightSource::start(core::TimeNs t_ns, rplidar::WireFormat wire,
                               core::TimeNs sample_period_ns) {
  simulator_.resume(t_ns, sample_period_ns);
  wire_ = wire;
  is_first_ = true;
  revolution_ = static_cast<std::int64_t>(std::floor(simulator_.head().angle_deg / 360));
}

WirePacket TimeOfFlightSource::next() {
  bytes_.clear();
  switch (wire_) {
    case rplidar::WireFormat::kStandard:
      append_node();
      break;
    case rplidar::WireFormat::kUltraDense:
      append_ultra_dense();
      break;
    case rplidar::WireFormat::kHq:
      append_hq();
      break;
    default:  // no lidar that measures time of flight sends another
      append_dense();
      break;
  }
  is_first_ = false;
  return {ready_ns_, bytes_, {}};
}

const std::vector<TimeOfFlightSource::Measured>& TimeOfFlightSource::measure(std::size_t count) {
  std::vector<RotatingHead::Position> heads;
  for (std::size_t k = 0; k < count; ++k) heads.push_back(simulator_.next_head());
  const double first_deg = std::round(heads.front().angle_deg * 64) / 64;
  const double next_deg = std::round(simulator_.head().angle_deg * 64) / 64;
  measured_.clear();
  for (std::size_t k = 0; k < count; ++k) {
    const double angle_deg =
        first_deg + (next_deg - first_deg) * static_cast<double>(k) / static_cast<double>(count);
    const auto revolution = static_cast<std::int64_t>(std::floor(angle_deg / 360));
    measured_.push_back(
        {angle_deg, simulator_.measure_m(heads[k].t_ns, angle_deg), revolution > revolution_});
    revolution_ = std::max(revolution_, revolution);
  }
  ready_ns_ = heads.back().t_ns + simulator_.period_ns();
  return measured_;
}

void TimeOfFlightSource::append(std::uint64_t value, int bytes) {
  for (int i = 0; i < bytes; ++i) bytes_.push_back(static_cast<std::uint8_t>(value >> 8 * i));
}

std::uint32_t TimeOfFlightSource::start_word() const {
  return angle_q6_of(measured_.front().angle_deg) | (is_first_ ? 0x8000U : 0U);
}

void TimeOfFlightSource::seal_capsule() {
  std::uint8_t sum = 0;
  for (std::size_t i = 2; i < bytes_.size(); ++i) sum ^= bytes_[i];
  bytes_[0] = static_cast<std::uint8_t>(0xA0 | (sum & 0xF));
  bytes_[1] = static_cast<std::uint8_t>(0x50 | sum >> 4);
}

void TimeOfFlightSource::append_node() {
  const Measured& sample = measure(1).front();
  const std::uint32_t dist_q2 = std::min(units(sample.range_m, 4e3), 0xFFFFU);
  append((dist_q2 > 0 ? kNodeQuality : 0U) << 2 | (sample.starts_scan ? 1U : 2U), 1);
  append(angle_q6_of(sample.angle_deg) << 1 | 1U, 2);
  append(dist_q2, 2);
}

void TimeOfFlightSource::append_dense() {
  measure(40);
  append(0, 2);
  append(start_word(), 2);
  for (const Measured& sample : measured_) append(std::min(units(sample.range_m, 1e3), 0xFFFFU), 2);
  seal_capsule();
}

void TimeOfFlightSource::append_ultra_dense() {
  measure(64);
  append(0, 2);
  append(static_cast<std::uint64_t>(ready_ns_ / 1000), 4);  // the device's clock
  append(0, 2);                                             // its status
  append(start_word(), 2);
  for (std::size_t k = 0; k < measured_.size(); k += 2) {
    const std::uint32_t one = scaled_sample(units(measured_[k].range_m, 1e3));
    const std::uint32_t two = scaled_sample(units(measured_[k + 1].range_m, 1e3));
    append(one & 0xFFFF, 2);
    append(two & 0xFFFF, 2);
    append(one >> 16 | two >> 16 << 4, 1);
  }
  seal_capsule();
}

void TimeOfFlightSource::append_hq() {
  measure(96);
  append(0xA5, 1);
  append(static_cast<std::uint64_t>(ready_ns_ / 1000), 8);
  for (const Measured& sample : measured_) {
    append(units(wrapped_deg(sample.angle_deg), 16384 / 90.0) % 0x10000, 2);
    append(units(sample.range_m, 4e3), 4);
    append(sample.range_m > 0 ? kByteQuality : 0, 1);
    append(sample.starts_scan ? 1 : 2, 1);
  }
  append(padded_crc(bytes_), 4);
}

}  // namespace cornerd::replay
