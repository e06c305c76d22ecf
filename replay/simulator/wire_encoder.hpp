// SPDX-License-Identifier: MIT
// Encodes samples as an RPLidar does: standard nodes, express and ultra capsules.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "drivers/rplidar/decoder.hpp"

namespace cornerd::replay {

inline constexpr std::size_t kExpressSamples = 32;
inline constexpr std::size_t kUltraSamples = 96;

using NodeBytes = std::array<std::uint8_t, 5>;
using ExpressBytes = std::array<std::uint8_t, 84>;
using UltraBytes = std::array<std::uint8_t, 132>;
using DescriptorBytes = std::array<std::uint8_t, 7>;

/// Response descriptor of the stream.
DescriptorBytes scan_descriptor(rplidar::WireFormat format);

/// `angle_q6`: degrees * 64, at most 15 bits; `dist_q2`: millimetres * 4, 0: no return.
NodeBytes encode_node(bool starts_scan, std::uint8_t quality, std::uint16_t angle_q6,
                      std::uint16_t dist_q2);

struct ExpressSample {
  std::uint16_t dist_mm = 0;   ///< 14 bits; 0: no return
  std::uint8_t offset_q3 = 0;  ///< degrees * 8 before the interpolated angle
};

/// `restart`: the first capsule of a stream.
ExpressBytes encode_express(std::uint16_t start_angle_q6, bool restart,
                            std::span<const ExpressSample, kExpressSamples> samples);

struct UltraCapsule {
  UltraBytes bytes{};
  /// The encoded distances: truncated to 1, 2, 4, 8 mm below 512, 2048, 4096, 16384 mm; 0 if the
  /// difference to the base does not fit.
  std::array<std::uint32_t, kUltraSamples> carried_mm{};
};

/// `dist_mm`: the capsule's samples and the first one of the next capsule, the base of the last
/// differences; at most 28,656 each.
UltraCapsule encode_ultra(std::uint16_t start_angle_q6, bool restart,
                          std::span<const std::uint32_t, kUltraSamples + 1> dist_mm);

}  // namespace cornerd::replay
