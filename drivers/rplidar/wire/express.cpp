// SPDX-License-Identifier: MIT
#include "drivers/rplidar/wire/express.hpp"

namespace cornerd::rplidar {
namespace {

constexpr std::size_t kCabinSize = 5;
constexpr std::size_t kExpressCabins = kExpressSamples / 2;

// The correction's six bits are unsigned: 0 to 7.875 degrees. The protocol paper calls the top one
// a sign; real devices disagree with it.
SweepSample decode_sample(const SweepCursor& cursor, int distance_word, int correction_low) {
  const int correction_q3 = correction_low | (distance_word & 3) << 4;
  return {.angle_q6 = SweepCursor::wrap_q6((cursor.raw_q16() - (correction_q3 << 13)) >> 10),
          .dist_q2 = static_cast<std::uint32_t>(distance_word & 0xFFFC),
          .starts_scan = cursor.starts_scan()};
}

}  // namespace

void decode_express(std::span<const std::uint8_t, kExpressSize> capsule, const Sweep& sweep,
                    std::span<SweepSample, kExpressSamples> samples) {
  SweepCursor cursor(sweep, sweep.diff_q6 << 5);  // Q6 to Q16 is 10 bits, less 5 for 32 samples
  for (std::size_t cabin = 0; cabin < kExpressCabins; ++cabin) {
    const auto bytes = capsule.subspan(kCapsuleHeaderSize + cabin * kCabinSize, kCabinSize);
    samples[2 * cabin] = decode_sample(cursor, bytes[0] | bytes[1] << 8, bytes[4] & 0xF);
    cursor.advance();
    samples[2 * cabin + 1] = decode_sample(cursor, bytes[2] | bytes[3] << 8, bytes[4] >> 4);
    cursor.advance();
  }
}

}  // namespace cornerd::rplidar
