// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "drivers/rplidar/decoder.hpp"
#include "drivers/rplidar/wire/byte_window.hpp"
#include "drivers/rplidar/wire/standard_node.hpp"

namespace cornerd::rplidar {

inline constexpr std::size_t kCapsuleHeaderSize = 4;
inline constexpr std::size_t kExpressSize = 84;
inline constexpr std::size_t kExpressSamples = 32;
inline constexpr std::size_t kUltraSize = 132;
inline constexpr std::size_t kUltraSamples = 96;

/// Bytes of a capsule. Not for kStandard.
constexpr std::size_t capsule_size(WireFormat format) {
  return format == WireFormat::kExpress ? kExpressSize : kUltraSize;
}
constexpr std::size_t capsule_samples(WireFormat format) {
  return format == WireFormat::kExpress ? kExpressSamples : kUltraSamples;
}

/// The first bytes carry two sync nibbles, and in their other halves the checksum.
bool has_capsule_sync(std::span<const std::uint8_t> bytes);
/// Of a whole capsule: XOR of all bytes but the first two.
bool has_right_checksum(std::span<const std::uint8_t> capsule);

/// Angle of the first sample, reduced to one turn.
int start_angle_q6(std::span<const std::uint8_t> capsule);
/// "The stream begins here": nothing leads from the capsule before to this one. Not a turn's mark.
bool begins_stream(std::span<const std::uint8_t> capsule);

/// Whether a capsule begins at the first of `bytes`, judged by its checksum and the header that
/// follows it: 24 bits. At the end of a recording (`final`) the checksum alone must do.
Verdict match_capsule(std::span<const std::uint8_t> bytes, WireFormat format, bool final);

/// The angles that a capsule's samples are spread over, up to the start of the next capsule.
struct Sweep {
  int start_q6 = 0;
  int diff_q6 = 0;
};

struct SweepSample {
  std::uint16_t angle_q6 = 0;
  std::uint32_t dist_q2 = 0;
  bool starts_scan = false;
};

/// Q16 arithmetic over a sweep, exactly as the vendor's SDK does it: truncation included.
class SweepCursor {
 public:
  SweepCursor(const Sweep& sweep, int inc_q16)
      : raw_q16_(sweep.start_q6 << 10), inc_q16_(inc_q16) {}

  int raw_q16() const { return raw_q16_; }
  /// The uncompensated angle passes zero after this sample: it is the first of a turn.
  bool starts_scan() const { return (raw_q16_ + inc_q16_) % kRevolutionQ16 < inc_q16_; }
  void advance() { raw_q16_ += inc_q16_; }

  static std::uint16_t wrap_q6(int angle_q6) {
    return static_cast<std::uint16_t>((angle_q6 % kFullRevolutionQ6 + kFullRevolutionQ6) %
                                      kFullRevolutionQ6);
  }

 private:
  static constexpr int kRevolutionQ16 = 360 << 16;
  int raw_q16_;
  int inc_q16_;
};

}  // namespace cornerd::rplidar
