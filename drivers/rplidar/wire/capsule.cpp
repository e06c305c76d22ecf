// SPDX-License-Identifier: MIT
#include "drivers/rplidar/wire/capsule.hpp"

#include <array>
#include <functional>
#include <numeric>

#include "drivers/rplidar/wire/hq_packet.hpp"
#include "drivers/rplidar/wire/ultra_capsule.hpp"

namespace cornerd::rplidar {
namespace {

std::uint32_t word_at(std::span<const std::uint8_t> bytes, std::size_t at) {
  return bytes[at] | static_cast<std::uint32_t>(bytes[at + 1]) << 8;
}

/// In an ultra-dense capsule a time of unknown unit and a status precede it.
std::uint32_t start_word(std::span<const std::uint8_t> capsule, WireFormat format) {
  return word_at(capsule, format == WireFormat::kUltraDense ? 8 : 2);
}

}  // namespace

bool has_capsule_sync(std::span<const std::uint8_t> bytes, WireFormat format) {
  if (format == WireFormat::kHq) return bytes[0] == kHqSync;
  return bytes[0] >> 4 == 0xA && bytes[1] >> 4 == 0x5;
}

bool has_right_checksum(std::span<const std::uint8_t> capsule, WireFormat format) {
  if (format == WireFormat::kHq) return has_right_crc(capsule);
  const int expected = (capsule[0] & 0xF) | (capsule[1] & 0xF) << 4;
  return std::accumulate(capsule.begin() + 2, capsule.end(), 0, std::bit_xor<>()) == expected;
}

int start_angle_q6(std::span<const std::uint8_t> capsule, WireFormat format) {
  if (format == WireFormat::kHq) return first_angle_q6(capsule);
  return static_cast<int>(start_word(capsule, format) & 0x7FFF) % kFullRevolutionQ6;
}

bool begins_stream(std::span<const std::uint8_t> capsule, WireFormat format) {
  return format != WireFormat::kHq && (start_word(capsule, format) & 0x8000) != 0;
}

Verdict match_capsule(std::span<const std::uint8_t> bytes, WireFormat format, bool final) {
  const Verdict too_few = final ? Verdict::kNo : Verdict::kMore;
  const std::size_t size = capsule_size(format);
  if (bytes.size() < 2) return too_few;
  if (!has_capsule_sync(bytes, format)) return Verdict::kNo;
  if (bytes.size() < size) return too_few;
  if (!has_right_checksum(bytes.first(size), format)) return Verdict::kNo;
  if (bytes.size() < size + 2) return final ? Verdict::kYes : Verdict::kMore;
  return has_capsule_sync(bytes.subspan(size), format) ? Verdict::kYes : Verdict::kNo;
}

namespace {

std::uint8_t quality_of(std::uint32_t distance) {
  return distance > 0 ? kUnknownQuality : std::uint8_t{0};
}

// The correction is unsigned, 0 to 7.875 degrees. The protocol paper calls its top bit a sign; real
// devices do not use it so.
SweepSample express_sample(const SweepCursor& cursor, std::uint32_t distance_word,
                           int correction_low) {
  const int correction_q3 = correction_low | static_cast<int>(distance_word & 3) << 4;
  const std::uint32_t dist_q2 = distance_word & 0xFFFC;
  return {.angle_q6 = SweepCursor::wrap_q6((cursor.raw_q16() - (correction_q3 << 13)) >> 10),
          .dist_q2 = dist_q2,
          .quality = quality_of(dist_q2),
          .starts_scan = cursor.starts_scan()};
}

/// 0x82: whole millimetres, angles corrected by the device in 1/8 degree.
void decode_express(std::span<const std::uint8_t> capsule, const Sweep& sweep,
                    std::span<SweepSample> samples) {
  constexpr std::size_t kCabinSize = 5;
  SweepCursor cursor(sweep, kExpressSamples);
  for (std::size_t cabin = 0; cabin < kExpressSamples / 2; ++cabin) {
    const auto bytes = capsule.subspan(kCapsuleHeaderSize + cabin * kCabinSize, kCabinSize);
    samples[2 * cabin] = express_sample(cursor, word_at(bytes, 0), bytes[4] & 0xF);
    cursor.advance();
    samples[2 * cabin + 1] = express_sample(cursor, word_at(bytes, 2), bytes[4] >> 4);
    cursor.advance();
  }
}

/// 0x85: whole millimetres at the head's angle.
void decode_dense(std::span<const std::uint8_t> capsule, const Sweep& sweep,
                  std::span<SweepSample> samples) {
  const std::size_t count = capsule_samples(WireFormat::kDense);
  SweepCursor cursor(sweep, count);
  for (std::size_t k = 0; k < count; ++k, cursor.advance()) {
    const std::uint32_t mm = word_at(capsule, kCapsuleHeaderSize + 2 * k);
    samples[k] = {.angle_q6 = SweepCursor::wrap_q6(cursor.raw_q16() >> 10),
                  .dist_q2 = 4 * mm,
                  .quality = quality_of(mm),
                  .starts_scan = cursor.starts_scan()};
  }
}

struct ScaledSample {
  std::uint32_t mm = 0;
  std::uint8_t quality = 0;
};

/// 20 bits: the scale s in two, a distance in 10 + s of them in steps of 2 + s mm, the quality's
/// upper bits in the rest.
ScaledSample decode_scaled(std::uint32_t bits) {
  constexpr std::array<std::uint32_t, 4> kFirstMm = {0, 2046, 8187, 24567};
  const std::uint32_t scale = bits & 3;
  const std::uint32_t steps = bits >> 2 & ((1U << (10 + scale)) - 1);
  return {kFirstMm[scale] + (2 + scale) * steps,
          static_cast<std::uint8_t>(bits >> (12 + scale) << scale)};
}

/// 0x86: two samples in five bytes, their upper nibbles in the last one.
void decode_ultra_dense(std::span<const std::uint8_t> capsule, const Sweep& sweep,
                        std::span<SweepSample> samples) {
  constexpr std::size_t kUltraDenseHeaderSize = 10;
  const std::size_t count = capsule_samples(WireFormat::kUltraDense);
  SweepCursor cursor(sweep, count);
  for (std::size_t k = 0; k < count; ++k, cursor.advance()) {
    const auto cabin = capsule.subspan(kUltraDenseHeaderSize + k / 2 * 5, 5);
    const std::uint32_t upper = k % 2 == 0 ? cabin[4] & 0xFU : cabin[4] >> 4U;
    const ScaledSample sample = decode_scaled(word_at(cabin, k % 2 * 2) | upper << 16);
    samples[k] = {.angle_q6 = SweepCursor::wrap_q6(cursor.raw_q16() >> 10),
                  .dist_q2 = 4 * sample.mm,
                  .quality = sample.quality,
                  .starts_scan = cursor.starts_scan()};
  }
}

}  // namespace

void decode_capsule(WireFormat format, std::span<const std::uint8_t> capsule,
                    std::span<const std::uint8_t> next, const Sweep& sweep,
                    std::span<SweepSample> samples) {
  switch (format) {
    case WireFormat::kStandard:
      return;
    case WireFormat::kExpress:
      return decode_express(capsule, sweep, samples);
    case WireFormat::kUltra:
      decode_ultra(capsule.first<kUltraSize>(), next.empty() ? 0 : first_major(next), sweep,
                   samples.first<kUltraSamples>());
      if (!next.empty()) return;
      // The last two distances are predicted from the next capsule.
      for (SweepSample& sample : samples.last(2)) sample.dist_q2 = sample.quality = 0;
      return;
    case WireFormat::kDense:
      return decode_dense(capsule, sweep, samples);
    case WireFormat::kUltraDense:
      return decode_ultra_dense(capsule, sweep, samples);
    case WireFormat::kHq:
      return decode_hq(capsule, samples);
  }
}

}  // namespace cornerd::rplidar
