// SPDX-License-Identifier: MIT
#include "drivers/ydlidar/ydlidar_decoder.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>

#include "core/geometry/angle.hpp"

namespace cornerd::ydlidar {
namespace {

/// The answer to the start of a scan; an X2 sends it when it is switched on.
constexpr std::array<std::uint8_t, 7> kScanDescriptor = {0xA5, 0x5A, 0x05, 0x00, 0x00, 0x40, 0x81};

constexpr double kFastFrom_hz = 4'000;

constexpr float kRevolution_deg = 360;
constexpr float kMaxGap_deg = 180;
/// Angles of undamaged packets jitter by so many samples; a lost packet has more, but the zero
/// packet.
constexpr float kJitter_samples = 4;

float wrap_deg(float angle_deg) {
  return angle_deg - kRevolution_deg * std::floor(angle_deg / kRevolution_deg);
}

}  // namespace

void YdlidarDecoder::feed(std::span<const std::uint8_t> bytes, drivers::FrameSink& sink) {
  counters_.bytes += bytes.size();
  while (!bytes.empty()) {
    bytes = bytes.subspan(window_.append(bytes));
    while (step(false, sink)) {
    }
  }
}

void YdlidarDecoder::finish(drivers::FrameSink& sink) {
  while (step(true, sink)) {
  }
}

drivers::FrameTiming YdlidarDecoder::timing() const {
  return {period_s_, kHeaderSize + 2 * packet_samples_, packet_samples_ - 1 - delivered_};
}

/// True if bytes were consumed.
bool YdlidarDecoder::step(bool final, drivers::FrameSink& sink) {
  const auto bytes = window_.unread();
  if (bytes.empty()) return false;
  const std::size_t count = std::min(bytes.size(), kScanDescriptor.size());
  if (std::equal(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(count),
                 kScanDescriptor.begin())) {
    if (count < kScanDescriptor.size()) return final && skip(1);
    window_.consume(count);
    counters_.used_bytes += count;
    return true;
  }
  if (bytes[0] == 0xAA && (bytes.size() < 2 || bytes[1] == 0x55)) {
    if (bytes.size() < kHeaderSize) return final && skip(1);
    if (has_header(bytes.first<kHeaderSize>())) return step_packet(bytes, final, sink);
  }
  if (locked_) ++counters_.resyncs;
  locked_ = false;
  return skip(1);
}

bool YdlidarDecoder::step_packet(std::span<const std::uint8_t> bytes, bool final,
                                 drivers::FrameSink& sink) {
  const std::size_t size = packet_size(bytes.first<kHeaderSize>());
  if (bytes.size() < size) return final && skip(1);
  if (has_right_check_code(bytes.first(size))) {
    locked_ = true;
    decode(parse_packet(bytes.first(size)), sink);
    window_.consume(size);
    counters_.used_bytes += size;
    return true;
  }
  if (bytes.size() < size + 2 && !final) return false;
  const auto next = bytes.subspan(size);
  const bool next_follows = next.size() >= 2 && next[0] == 0xAA && next[1] == 0x55;
  if (next_follows || locked_) {
    ++counters_.bad_checksums;
    damaged_ = true;
  }
  if (!next_follows && locked_) ++counters_.resyncs;
  locked_ = next_follows;
  return skip(next_follows ? size : 1);
}

bool YdlidarDecoder::skip(std::size_t count) {
  window_.consume(count);
  counters_.skipped_bytes += count;
  return true;
}

void YdlidarDecoder::decode(const Packet& packet, drivers::FrameSink& sink) {
  if (packet.samples > 1) {
    const float span_deg = wrap_deg(packet.last_deg - packet.first_deg);
    // The manual's clockwise difference; more than this is a jitter backwards.
    if (span_deg < kMaxGap_deg) step_deg_ = span_deg / static_cast<float>(packet.samples - 1);
  }
  if (packet.rate_hz > 0 && step_deg_ > 0) {
    const double samples_hz = packet.rate_hz * kRevolution_deg / step_deg_;
    period_s_ = samples_hz < kFastFrom_hz ? kPeriodX2S : kPeriodX4S;
  }
  if (has_last_) count_missing(packet, sink);
  packet_samples_ = packet.samples;
  float raw_deg = wrap_deg(packet.first_deg);
  for (std::size_t i = 0; i < packet.samples; ++i) {
    delivered_ = i;
    raw_deg = wrap_deg(packet.first_deg + step_deg_ * static_cast<float>(i));
    const bool starts_scan = revolution_.passes(raw_deg);
    const int dist_q2 = packet.dist_q2(i);
    const float angle_deg = wrap_deg(raw_deg + angle_correction_deg(dist_q2));
    const float signed_deg = angle_deg > 180 ? angle_deg - kRevolution_deg : angle_deg;
    ++counters_.samples;
    if (starts_scan) ++counters_.scans;
    sink.on_sample({.index = index_++,
                    .device_rad = static_cast<float>(core::radians(signed_deg)),
                    .range_m = static_cast<float>(dist_q2) / 4000,
                    .quality = 0,
                    .starts_scan = starts_scan});
  }
  last_deg_ = raw_deg;
  has_last_ = true;
  damaged_ = false;
}

void YdlidarDecoder::count_missing(const Packet& packet, drivers::FrameSink& sink) {
  if (step_deg_ <= 0) return;
  const float way_deg = wrap_deg(packet.first_deg - last_deg_);
  const float samples = std::round(way_deg / step_deg_);
  const bool is_behind = way_deg > kRevolution_deg - kJitter_samples * step_deg_;
  if (samples <= 1 || is_behind || (!damaged_ && samples <= kJitter_samples)) return;
  if (!damaged_) ++counters_.lost_capsules;
  index_ += static_cast<std::uint64_t>(samples) - 1;
  revolution_.after_gap();
  if (way_deg > kMaxGap_deg) sink.on_gap();
}

}  // namespace cornerd::ydlidar
