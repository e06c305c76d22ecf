// SPDX-License-Identifier: MIT
#include "drivers/rplidar/wire/ultra_capsule.hpp"

#include <array>
#include <numbers>

namespace cornerd::rplidar {
namespace {

constexpr std::size_t kUltraCabins = kUltraSamples / 3;

std::uint32_t cabin_word(std::span<const std::uint8_t> capsule, std::size_t cabin) {
  const auto bytes = capsule.subspan(kCapsuleHeaderSize + cabin * 4, 4);
  return bytes[0] | static_cast<std::uint32_t>(bytes[1]) << 8 |
         static_cast<std::uint32_t>(bytes[2]) << 16 | static_cast<std::uint32_t>(bytes[3]) << 24;
}

int major_of(std::uint32_t word) { return static_cast<int>(word & 0xFFF); }

int sign_extend_10(std::uint32_t bits) {
  return static_cast<int>(bits & 0x3FF) - ((bits & 0x200) != 0 ? 1024 : 0);
}

int predict(const VarbitDistance& base, int prediction) {
  constexpr int kNoReturnLow = -512;
  constexpr int kNoReturnHigh = 511;
  if (prediction == kNoReturnLow || prediction == kNoReturnHigh) return 0;
  const int mm = base.mm + prediction * (1 << base.level);
  return mm > 0 ? mm : 0;
}

// The wire has the head's angle; the point lies 8 deg - asin(24 mm / d) before it, by triangulation
// between laser and lens. Two terms of the arcsine, as in the vendor's SDK.
int optical_correction_q16_degrees(int dist_q2) {
  constexpr double kRadian = std::numbers::pi / 180 * (1 << 16);
  constexpr int kNear = static_cast<int>(7.5 * kRadian);
  constexpr int kFar = static_cast<int>(8.0 * kRadian);
  constexpr int kMinCorrectedQ2 = 50 * 4;
  constexpr int kLensQ2 = 98361;  // 24 mm, in units that fit the next line
  int correction_q16 = kNear;
  if (dist_q2 >= kMinCorrectedQ2) {
    const int k = kLensQ2 / dist_q2;
    correction_q16 = kFar - (k << 6) - (k * k * k) / 98304;
  }
  return static_cast<int>(correction_q16 * 180 / 3.14159265);
}

}  // namespace

VarbitDistance decode_varbit(int code) {
  struct Range {
    int first_code;
    int first_mm;
    int level;
  };
  constexpr std::array<Range, 5> kRanges{
      {{3328, 16384, 4}, {1792, 4096, 3}, {1280, 2048, 2}, {512, 512, 1}, {0, 0, 0}}};
  for (const Range& range : kRanges) {
    if (code >= range.first_code) {
      return {range.first_mm + (code - range.first_code) * (1 << range.level), range.level};
    }
  }
  return {};
}

int first_major(std::span<const std::uint8_t> capsule) { return major_of(cabin_word(capsule, 0)); }

void decode_ultra(std::span<const std::uint8_t, kUltraSize> capsule, int next_major,
                  const Sweep& sweep, std::span<SweepSample, kUltraSamples> samples) {
  SweepCursor cursor(sweep, kUltraSamples);
  for (std::size_t cabin = 0; cabin < kUltraCabins; ++cabin) {
    const std::uint32_t word = cabin_word(capsule, cabin);
    const VarbitDistance major = decode_varbit(major_of(word));
    const VarbitDistance next = decode_varbit(
        cabin + 1 < kUltraCabins ? major_of(cabin_word(capsule, cabin + 1)) : next_major);
    const VarbitDistance& first_base = major.mm == 0 ? next : major;

    const std::array<int, 3> distances_mm{major.mm, predict(first_base, sign_extend_10(word >> 12)),
                                          predict(next, sign_extend_10(word >> 22))};
    for (std::size_t part = 0; part < distances_mm.size(); ++part) {
      const int dist_q2 = distances_mm[part] * 4;
      const int angle_q6 = (cursor.raw_q16() - optical_correction_q16_degrees(dist_q2)) >> 10;
      samples[3 * cabin + part] = {.angle_q6 = SweepCursor::wrap_q6(angle_q6),
                                   .dist_q2 = static_cast<std::uint32_t>(dist_q2),
                                   .quality = dist_q2 > 0 ? kUnknownQuality : std::uint8_t{0},
                                   .starts_scan = cursor.starts_scan()};
      cursor.advance();
    }
  }
}

}  // namespace cornerd::rplidar
