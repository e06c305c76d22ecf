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
inline constexpr std::size_t kMaxCapsuleSize = 781;  ///< HQ
inline constexpr std::size_t kMaxCapsuleSamples = 96;

struct CapsuleLayout {
  std::size_t size = 0;
  std::size_t samples = 0;
};

/// Not for kStandard.
constexpr CapsuleLayout capsule_layout(WireFormat format) {
  switch (format) {
    case WireFormat::kStandard:
    case WireFormat::kExpress:
      break;
    case WireFormat::kUltra:
      return {kUltraSize, kUltraSamples};
    case WireFormat::kDense:
      return {84, 40};
    case WireFormat::kUltraDense:
      return {170, 64};
    case WireFormat::kHq:
      return {kMaxCapsuleSize, kMaxCapsuleSamples};
  }
  return {kExpressSize, kExpressSamples};
}
constexpr std::size_t capsule_size(WireFormat format) { return capsule_layout(format).size; }
constexpr std::size_t capsule_samples(WireFormat format) { return capsule_layout(format).samples; }

/// The two sync nibbles, in whose other halves the checksum is; of HQ the byte A5. `bytes`: at
/// least 2.
bool has_capsule_sync(std::span<const std::uint8_t> bytes, WireFormat format);
/// XOR of all bytes of a whole capsule but the first two; of HQ a CRC-32.
bool has_right_checksum(std::span<const std::uint8_t> capsule, WireFormat format);

/// Angle of the first sample, in [0, 360 * 64).
int start_angle_q6(std::span<const std::uint8_t> capsule, WireFormat format);
/// The flag of a stream's first capsule. Not a scan start.
bool begins_stream(std::span<const std::uint8_t> capsule, WireFormat format);

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
  std::uint8_t quality = 0;
  bool starts_scan = false;
};

/// Angles of a sweep's samples in Q16, truncated exactly as in the vendor's SDK.
class SweepCursor {
 public:
  SweepCursor(const Sweep& sweep, std::size_t samples)
      : raw_q16_(sweep.start_q6 << 10),
        inc_q16_((sweep.diff_q6 << 10) / static_cast<int>(samples)),
        end_q16_((sweep.start_q6 + sweep.diff_q6) << 10),
        left_(samples) {}

  int raw_q16() const { return raw_q16_; }
  /// As in the SDK: the sample before the uncorrected angle passes zero.
  bool starts_scan() const { return raw_q16_ < kRevolutionQ16 && next_q16() >= kRevolutionQ16; }
  void advance() {
    raw_q16_ = next_q16();
    --left_;
  }

  static std::uint16_t wrap_q6(int angle_q6) {
    return static_cast<std::uint16_t>((angle_q6 % kFullRevolutionQ6 + kFullRevolutionQ6) %
                                      kFullRevolutionQ6);
  }

 private:
  static constexpr int kRevolutionQ16 = 360 << 16;
  /// After the last sample comes the next capsule's first, which the truncated step may not reach.
  int next_q16() const { return left_ > 1 ? raw_q16_ + inc_q16_ : end_q16_; }

  int raw_q16_;
  int inc_q16_;
  int end_q16_;
  std::size_t left_;
};

/// What the formats without a quality report where there is a return; the SDK's value.
inline constexpr std::uint8_t kUnknownQuality = 47;

/// Samples of a capsule. `next`: the one after it, whose first distance ends an ultra capsule;
/// empty if it is missing.
void decode_capsule(WireFormat format, std::span<const std::uint8_t> capsule,
                    std::span<const std::uint8_t> next, const Sweep& sweep,
                    std::span<SweepSample> samples);

}  // namespace cornerd::rplidar
