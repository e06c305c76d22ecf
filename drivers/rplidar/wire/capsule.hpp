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
/// XOR of all bytes of a whole capsule but the first two.
bool has_right_checksum(std::span<const std::uint8_t> capsule);

/// Angle of the first sample, in [0, 360 * 64).
int start_angle_q6(std::span<const std::uint8_t> capsule);
/// The flag of a stream's first capsule. Not a scan start.
bool begins_stream(std::span<const std::uint8_t> capsule);

/// Whether a capsule begins at the first of `bytes`: by its checksum and the sync of the next
/// header, 24 bits. At the end of a recording (`final`) by the checksum alone.
Verdict match_capsule(std::span<const std::uint8_t> bytes, WireFormat format, bool final);

/// A capsule's start angle and the angle to the next capsule's start.
struct Sweep {
  int start_q6 = 0;
  int diff_q6 = 0;
};

struct SweepSample {
  std::uint16_t angle_q6 = 0;
  std::uint32_t dist_q2 = 0;
  bool starts_scan = false;
};

/// Angles of a sweep's samples in Q16, truncated exactly as in the vendor's SDK.
class SweepCursor {
 public:
  SweepCursor(const Sweep& sweep, int inc_q16)
      : raw_q16_(sweep.start_q6 << 10), inc_q16_(inc_q16) {}

  int raw_q16() const { return raw_q16_; }
  /// As in the SDK: the sample before the uncorrected angle passes zero.
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

/// Samples of an express capsule (answer type 0x82): whole millimetres, angles corrected by the
/// device in 1/8 degree.
void decode_express(std::span<const std::uint8_t, kExpressSize> capsule, const Sweep& sweep,
                    std::span<SweepSample, kExpressSamples> samples);

struct VarbitDistance {
  int mm = 0;
  int level = 0;  ///< its predictions have steps of 2^level mm
};

/// The 12-bit floating point of the ultra format: 1 mm steps below 512 mm, 16 mm beyond 16384.
VarbitDistance decode_varbit(int code);

/// Samples of an ultra capsule (answer type 0x84). `next_major`: first_major() of the next capsule,
/// the base of the last predictions. A negative distance is no return.
void decode_ultra(std::span<const std::uint8_t, kUltraSize> capsule, int next_major,
                  const Sweep& sweep, std::span<SweepSample, kUltraSamples> samples);

/// The 12-bit code of a capsule's first distance.
int first_major(std::span<const std::uint8_t> capsule);

}  // namespace cornerd::rplidar
