// SPDX-License-Identifier: MIT
#include "drivers/ld/ld_decoder.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/geometry/angle.hpp"

namespace cornerd::ld {
namespace {

// LD06 and LD19 have 4500 samples a second, STL-19P 5000: within the sample clock's reach.
constexpr double kPeriodS = 1 / 4'500.0;
constexpr double kFastPeriodS = 1 / 21'600.0;  // STL-27L
constexpr double kFastFrom_hz = 10'000;

// Limits of a search: the models rotate at 5 to 13 Hz, and 12 samples take 0.5 to 2.7 ms.
constexpr int kMaxSpeed_deg_s = 20 * 360;
constexpr int kMaxSpan_cdeg = 2'000;

constexpr int kMaxGap_cdeg = kRevolution_cdeg / 2;

}  // namespace

void LdDecoder::feed(std::span<const std::uint8_t> bytes, drivers::FrameSink& sink) {
  counters_.bytes += bytes.size();
  while (!bytes.empty()) {
    bytes = bytes.subspan(window_.append(bytes));
    while (step(false, sink)) {
    }
  }
}

void LdDecoder::finish(drivers::FrameSink& sink) {
  while (step(true, sink)) {
  }
}

drivers::FrameTiming LdDecoder::timing() const {
  return {period_s_ > 0 ? period_s_ : kPeriodS, kPacketSize, kPacketSamples - 1};
}

/// True if bytes were consumed.
bool LdDecoder::step(bool final, drivers::FrameSink& sink) {
  const auto bytes = window_.unread();
  if (bytes.empty()) return false;
  const bool may_begin = bytes.size() == 1 ? bytes[0] == 0x54 : has_header(bytes);
  if (!may_begin) {
    if (locked_) ++counters_.resyncs;
    locked_ = false;
    return skip(1);
  }
  if (bytes.size() < kPacketSize) return final && skip(1);
  const auto frame = bytes.first<kPacketSize>();
  if (has_right_crc(frame)) {
    const Packet packet = parse_packet(frame);
    if (locked_ || is_plausible(packet)) {
      locked_ = true;
      window_.consume(kPacketSize);
      counters_.used_bytes += kPacketSize;
      decode(packet, sink);
      return true;
    }
  }
  if (bytes.size() < kPacketSize + 2 && !final) return false;
  const bool next_follows = has_header(bytes.subspan(kPacketSize));
  if (next_follows || locked_) {
    ++counters_.bad_checksums;
    ++damaged_;
  }
  if (!next_follows && locked_) ++counters_.resyncs;
  locked_ = next_follows;
  return skip(next_follows ? kPacketSize : 1);
}

bool LdDecoder::skip(std::size_t count) {
  window_.consume(count);
  counters_.skipped_bytes += count;
  return true;
}

bool LdDecoder::is_plausible(const Packet& packet) const {
  return packet.speed_deg_s > 0 && packet.speed_deg_s <= kMaxSpeed_deg_s &&
         packet.span_cdeg() > 0 && packet.span_cdeg() <= kMaxSpan_cdeg;
}

void LdDecoder::decode(const Packet& packet, drivers::FrameSink& sink) {
  if (period_s_ <= 0) {
    const double step_deg = packet.span_cdeg() / 100.0 / (kPacketSamples - 1);
    period_s_ = packet.speed_deg_s > kFastFrom_hz * step_deg ? kFastPeriodS : kPeriodS;
  }
  if (has_last_) count_missing(packet, sink);
  deliver(packet, sink);
  last_ = packet;
  has_last_ = true;
  damaged_ = 0;
}

/// The angle since the last packet counts the missing ones up to whole revolutions, which the
/// device's clock gives. A wrong CRC is not a packet: it may be a false header in foreign bytes.
void LdDecoder::count_missing(const Packet& packet, drivers::FrameSink& sink) {
  const double packet_cdeg = last_.span_cdeg() * (kPacketSamples / (kPacketSamples - 1.0));
  const int swept_cdeg =
      (packet.start_cdeg - last_.start_cdeg + kRevolution_cdeg) % kRevolution_cdeg;
  const int elapsed_ms = (packet.t_ms - last_.t_ms + kClockWrap_ms) % kClockWrap_ms;
  const double turned_cdeg = elapsed_ms * 0.1 * last_.speed_deg_s;
  const double revolutions =
      std::max(0.0, std::round((turned_cdeg - swept_cdeg) / kRevolution_cdeg));
  const double way_cdeg = swept_cdeg + revolutions * kRevolution_cdeg;
  const double packets = packet_cdeg > 0 ? std::round(way_cdeg / packet_cdeg) : 1 + damaged_;
  if (packets <= 1) return;
  const auto missing = static_cast<std::uint64_t>(packets) - 1;
  counters_.lost_capsules += missing - std::min(missing, damaged_);
  index_ += missing * kPacketSamples;
  revolution_.after_gap();
  if (way_cdeg > kMaxGap_cdeg) sink.on_gap();
}

void LdDecoder::deliver(const Packet& packet, drivers::FrameSink& sink) {
  const float step_deg = static_cast<float>(packet.span_cdeg()) / (100 * (kPacketSamples - 1));
  float angle_deg = static_cast<float>(packet.start_cdeg) / 100;
  for (std::size_t i = 0; i < kPacketSamples; ++i, angle_deg += step_deg) {
    if (angle_deg >= 360) angle_deg -= 360;
    const bool starts_scan = revolution_.passes(angle_deg);
    ++counters_.samples;
    if (starts_scan) ++counters_.scans;
    const float signed_deg = angle_deg > 180 ? angle_deg - 360 : angle_deg;
    sink.on_sample({.index = index_++,
                    .device_rad = static_cast<float>(core::radians(signed_deg)),
                    .range_m = static_cast<float>(packet.dist_mm[i]) / 1000,
                    .quality = packet.dist_mm[i] > 0 ? packet.confidence[i] : std::uint8_t{0},
                    .starts_scan = starts_scan});
  }
}

}  // namespace cornerd::ld
